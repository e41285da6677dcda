#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

/// The unmodified program and vendors' libraries that it finds as the loader does: stand-ins with the public signatures.
namespace reachlab::test {
namespace {

using Json = nlohmann::json;

const std::string kFakes = "LD_LIBRARY_PATH=\"" REACHLAB_FAKE_LIBRARIES "\" FAKE_HD_ALONE=1";

Json rowOf(const std::string& output, const std::string& name) {
  for (const Json& row : Json::parse(output))
    if (row["name"] == name) return row;
  return nullptr;
}

TEST(Devices, ListSaysWhyAVendorsLibraryIsNotThereInTheLoadersWords) {
  const Ended listed = reach("list devices --json", "LD_LIBRARY_PATH=");
  ASSERT_EQ(listed.exitCode, 0) << listed.err;
  const Json phantom = rowOf(listed.out, "phantom");
  EXPECT_EQ(phantom["present"], false);
  EXPECT_NE(phantom["why_not"].get<std::string>().find("libHD.so: cannot open shared object file"), std::string::npos);
  EXPECT_TRUE(phantom["max_force_n"].is_null());
  for (const Json& row : Json::parse(listed.out))
    for (const char* key : {"name", "kind", "present", "why_not", "degrees_of_freedom", "max_force_n", "continuous_force_n", "rate_hz"})
      EXPECT_TRUE(row.contains(key)) << row["name"] << " " << key;
}

TEST(Devices, ListShowsWhatIsThereWithTheDevicesOwnLimits) {
  const Ended listed = reach("list devices --json", kFakes);
  ASSERT_EQ(listed.exitCode, 0) << listed.err;
  const Json phantom = rowOf(listed.out, "phantom");
  EXPECT_EQ(phantom["present"], true) << phantom;
  EXPECT_EQ(phantom["max_force_n"], 3.3);
  EXPECT_EQ(phantom["continuous_force_n"], 0.88);
  EXPECT_EQ(rowOf(listed.out, "forcedimension:0")["present"], true);
}

TEST(Devices, ADeviceThatCannotBeHadIsExitThreeWithItsNameAndTheLoadersWords) {
  const Folder folder;
  const Ended run = reach("run chain-slow --device phantom --data " + folder.string(), "LD_LIBRARY_PATH=");
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_NE(run.err.find("libHD.so"), std::string::npos) << run.err;
  const Ended none = reach("run chain-slow --device phantom:Nowhere --data " + folder.string(), kFakes);
  EXPECT_EQ(none.exitCode, 3);
  EXPECT_NE(none.err.find("phantom:Nowhere"), std::string::npos) << none.err;
}

TEST(Devices, AnUnknownDeviceIsAWrongUse) {
  const Folder folder;
  EXPECT_EQ(reach("run chain-slow --device theremin --data " + folder.string()).exitCode, 2);
  EXPECT_EQ(reach("run chain-slow --device virtual:omni,colour=red --data " + folder.string()).exitCode, 2);
}

TEST(Devices, AVirtualDeviceRunsFastAndItsRecordingReplaysToTheBit) {
  const Folder folder;
  const Ended run = reach("run chain-moderate --device virtual:premium15 --trials 2 --seed 1 --fast --data " + folder.string());
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(trialLines(run.out).size(), 2u);
  const Ended replay = reach("replay " + folder.string() + "/sourcedata/*.reach --check");
  EXPECT_EQ(replay.exitCode, 0) << replay.out << replay.err;
}

}  // namespace
}  // namespace reachlab::test
