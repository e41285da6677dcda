#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "tests/cli/patient.h"
#include "tests/cli/program.h"
#include "tests/devices/fakes/fake_haply.h"

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

class Devices : public InAFolder {};

TEST_F(Devices, ListSaysWhyAVendorsLibraryIsNotThereInTheLoadersWords) {
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

TEST_F(Devices, ListShowsWhatIsThereWithTheDevicesOwnLimits) {
  const Ended listed = reach("list devices --json", kFakes);
  ASSERT_EQ(listed.exitCode, 0) << listed.err;
  const Json phantom = rowOf(listed.out, "phantom");
  EXPECT_EQ(phantom["present"], true) << phantom;
  EXPECT_EQ(phantom["max_force_n"], 3.3);
  EXPECT_EQ(phantom["continuous_force_n"], 0.88);
  EXPECT_EQ(rowOf(listed.out, "forcedimension:0")["present"], true);
}

TEST_F(Devices, ADeviceThatCannotBeHadIsExitThreeWithItsNameAndTheLoadersWords) {
  const Ended run = reach("run chain-slow --device phantom --data " + folder_.path(), "LD_LIBRARY_PATH=");
  EXPECT_TRUE(says(run, 3, "device phantom: libHD.so"));
  EXPECT_TRUE(says(reach("run chain-slow --device phantom:Nowhere --data " + folder_.path(), kFakes), 3, "phantom:Nowhere"));
}

TEST_F(Devices, AnUnknownDeviceIsAWrongUse) {
  EXPECT_EQ(reach("run chain-slow --device theremin --data " + folder_.path()).exitCode, 2);
  EXPECT_EQ(reach("run chain-slow --device virtual:omni,colour=red --data " + folder_.path()).exitCode, 2);
}

TEST_F(Devices, ValidateSaysBeforehandWhatADeviceCannotGive) {
  const Ended checked = reach("validate chain-fast --device virtual:omni");
  EXPECT_EQ(checked.exitCode, 0) << checked.err;
  EXPECT_NE(checked.out.find("warning  peak force: the reach needs "), std::string::npos) << checked.out;
  const Json rows = Json::parse(reach("validate chain-fast --device virtual:omni --json").out);
  EXPECT_EQ(rows[0]["name"], "peak_force");
  EXPECT_EQ(rows[0]["verdict"], "warning");
  EXPECT_EQ(rows[0]["limit"], 3.3);
  EXPECT_GT(rows[0]["asked"], 3.3);
}

TEST_F(Devices, BothOfTwoHandsAreCheckedBeforehand) {
  const std::string hands = "chain-two-hands --device \"virtual:highforce + virtual:omni,scale=0.5\"";
  const Ended checked = reach("validate " + hands);
  EXPECT_EQ(checked.exitCode, 0) << checked.err;
  EXPECT_NE(checked.out.find("fine     hand 1: peak force"), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("warning  hand 2: workspace"), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("High Force + virtual PHANToM Omni"), std::string::npos) << checked.out;
  const Json rows = Json::parse(reach("validate " + hands + " --json").out);
  EXPECT_EQ(rows.front()["hand"], 1);
  EXPECT_EQ(rows.back()["hand"], 2);
  const Ended run = reach("run " + hands + " --trials 1 --seed 1 --fast --data " + folder_.path());
  EXPECT_NE(run.err.find("warning: hand 2: workspace"), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("warning: hand 1"), std::string::npos) << run.err;
}

TEST_F(Devices, RunWarnsOfADeviceThatIsTooWeakAndOfNoOther) {
  const std::string rest = " --trials 1 --seed 1 --fast --data " + folder_.path();
  EXPECT_TRUE(says(reach("run chain-fast --device virtual:omni" + rest), 0, "warning: peak force: "));
  const Ended strong = reach("run chain-slow --device virtual:premium15" + rest);
  EXPECT_EQ(strong.err.find("warning: "), std::string::npos) << strong.err;
}

TEST_F(Devices, AMappingIsKeptForDeviceAndSubjectAndRecordedWithTheRun) {
  const std::string rest = " --trials 1 --seed 1 --fast --data " + folder_.path();
  EXPECT_EQ(reach("run chain-slow --device virtual:premium15 --subject 03 --save-mapping" + rest).exitCode, 2) << "there is none to keep";
  const Ended first = reach("run chain-slow --device virtual:premium15,scale=1.25,wall=yes --subject 03 --save-mapping" + rest);
  ASSERT_EQ(first.exitCode, 0) << first.err;
  const Json kept = Json::parse(contentOf(folder_ / "sourcedata/mappings/sub-03_virtual-premium15.json"));
  EXPECT_EQ(kept["scale"], 1.25);
  const Ended again = reach("run chain-slow --device virtual:premium15 --subject 03" + rest);
  EXPECT_NE(again.err.find("mapping of "), std::string::npos) << again.err;
  const Ended other = reach("run chain-slow --device virtual:premium15 --subject 04" + rest);
  EXPECT_EQ(other.err.find("mapping of "), std::string::npos) << other.err;
  const std::string name = folder_.path() + "/sourcedata/sub-03_ses-01_task-chainslow_run-01_log.reach";
  const Ended replay = reach("replay " + name + " --check");
  EXPECT_EQ(replay.exitCode, 0) << replay.out << replay.err;
  const std::string log = contentOf(name);
  EXPECT_NE(log.find("port_energy_j"), std::string::npos);
  EXPECT_NE(log.find("\\\"scale\\\":1.25"), std::string::npos) << "the mapping is in the recording";
  EXPECT_NE(log.find("homed"), std::string::npos) << "and so are the device's states";
  const std::string felt = contentOf(folder_ / "sourcedata/sub-04_ses-01_task-chainslow_run-01_log.reach");
  EXPECT_NE(felt.find("engaged"), std::string::npos);
}

TEST_F(Devices, OfTwoHandsEachKeepsItsOwnMapping) {
  const std::string rest = " --subject 03 --trials 1 --seed 1 --fast --data " + folder_.path();
  const Ended first =
      reach("run chain-two-hands --device \"virtual:premium15,scale=1.25 + virtual:omni,scale=0.5,mirror=x\" --save-mapping" + rest);
  ASSERT_EQ(first.exitCode, 0) << first.err;
  EXPECT_EQ(Json::parse(contentOf(folder_ / "sourcedata/mappings/sub-03_virtual-premium15.json"))["scale"], 1.25);
  EXPECT_EQ(Json::parse(contentOf(folder_ / "sourcedata/mappings/sub-03_virtual-omni.json"))["mirror_x"], true);
  const Ended again = reach("run chain-two-hands --device virtual:premium15 --device virtual:omni" + rest);
  EXPECT_NE(again.err.find("sub-03_virtual-premium15.json"), std::string::npos) << again.err;
  EXPECT_NE(again.err.find("sub-03_virtual-omni.json"), std::string::npos) << again.err;
  const std::string log = contentOf(folder_.path() + "/sourcedata/sub-03_ses-01_task-chaintwohands_run-02_log.reach");
  EXPECT_NE(log.find("\\\"scale\\\":1.25"), std::string::npos);
  EXPECT_NE(log.find("\\\"scale\\\":0.5"), std::string::npos);
}

// A scheduler that never calls, calls twice, or stands still for 30 ms each second: the run is done, or is given up in words.
TEST_F(Devices, ASchedulerThatNeverCallsOrTwiceOrLateEndsInWords) {
  for (const char* fault : {"NEVER", "TWICE", "LATE"}) {
    const Ended run = reach("run chain-slow --device phantom --trials 1 --seed 1 --timing-check 0 --data " + folder_.path(),
                            kFakes + " FAKE_HD_" + fault + "=1 timeout -s INT 30");
    EXPECT_TRUE(run.exitCode == 0 || run.exitCode == 3) << fault << ": " << run.exitCode << run.err;
    if (run.exitCode == 3) {
      EXPECT_NE(run.err.find("device PHANToM"), std::string::npos) << fault << ": " << run.err;
    }
    if (std::string(fault) == "NEVER") {
      EXPECT_EQ(run.exitCode, 3) << run.out;
      ASSERT_EQ(trialLines(run.out).size(), 1u) << run.out;
      EXPECT_EQ(trialLines(run.out)[0].at("reason"), "device_lost");
    }
  }
}

// What each of the stand-in's omegas felt: the largest norm, and what was left when it was closed. [N]
std::map<int, std::pair<double, double>> diaryOf(const std::filesystem::path& file) {
  std::map<int, std::pair<double, double>> felt;
  std::ifstream in(file);
  int id = 0;
  double most = 0, last = 0;
  while (in >> id >> most >> last) felt[id] = {most, last};
  return felt;
}

TEST_F(Devices, TwoOmegasAreTwoHandsOfOneExperiment) {
  const std::string diary = folder_ / "diary";
  const Ended run = reachUndisturbed("run " + patient(folder_, "chain-two-hands") +
                                         " --device \"forcedimension:0 + forcedimension:1\" --trials 1 --seed 1 --timing-check 0 --data " +
                                         folder_.path(),
                                     kFakes + " FAKE_DHD_DEVICES=2 FAKE_DHD_ALONE=1 FAKE_DHD_DIARY=" + diary + " timeout -s INT 30");
  EXPECT_TRUE(run.exitCode == 0 || run.exitCode == 3) << run.exitCode << run.err;
  EXPECT_EQ(trialLines(run.out).size(), 1u) << run.out << run.err;
  const auto felt = diaryOf(diary);
  ASSERT_EQ(felt.size(), 2u);
  for (const auto& [id, force] : felt) {
    EXPECT_TRUE(force.first > 0 || isDisturbed(run)) << id << run.err;
    EXPECT_LE(force.first, 12 + 1e-9) << id;
    EXPECT_EQ(force.second, 0) << id;
  }
}

// A stand-in's handle moves from 1.5 s to 2.85 s after it was opened; with its supply gone in the middle of that, the run is given up in words.
void expectLost(const Ended& run, const std::string& device) {
  EXPECT_EQ(run.exitCode, 3) << run.out << run.err;
  EXPECT_NE(run.out.find("outcome=interrupted reason=device_lost"), std::string::npos) << run.out << run.err;
  EXPECT_TRUE(run.err.find(device) != std::string::npos || isDisturbed(run)) << run.err;
}

TEST_F(Devices, APhantomLostInMidTrialInterruptsIt) {
  expectLost(reachUndisturbed("run " + patient(folder_, "chain-slow") + " --device phantom --trials 1 --seed 1 --timing-check 0 --data " +
                                  folder_.path(),
                              kFakes + " FAKE_HD_LOST_AFTER=2.2 timeout -s INT 30"),
             "PHANToM");
}

TEST_F(Devices, OneOfTwoOmegasLostInMidTrialInterruptsItAndTakesTheForceFromBoth) {
  const std::string diary = folder_ / "diary";
  expectLost(reachUndisturbed(
                 "run " + patient(folder_, "chain-two-hands") +
                     " --device \"forcedimension:0 + forcedimension:1\" --trials 1 --seed 1 --timing-check 0 --data " + folder_.path(),
                 kFakes + " FAKE_DHD_DEVICES=2 FAKE_DHD_ALONE=1 FAKE_DHD_LOST_AFTER=2.2 FAKE_DHD_DIARY=" + diary + " timeout -s INT 30"),
             "device omega.3 4712 is lost");
  EXPECT_EQ(diaryOf(diary)[0].second, 0) << "the one that is still there";
}

// To the right and back, as the other stand-ins.
Vec3 reachAgainAndAgain(double seconds) {
  const double t = std::fmod(seconds, 4.0) - 1.5, s = std::clamp(t / 1.35, 0.0, 1.0);
  return {t > 2.2 ? 0.1 - 0.2 * (t - 2.2) / 0.3 : -0.1 + 0.2 * s * s * s * (10 + s * (6 * s - 15)), 0, 0};
}

TEST_F(Devices, AnInverse3WhoseServiceEndsInMidTrialInterruptsIt) {
  FakeHaply service;
  service.moveBy(reachAgainAndAgain);
  std::jthread ending([&](const std::stop_token& over) {
    while (!over.stop_requested() && !(service.largestForce() > 0)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    service.end();
  });
  expectLost(reach("run " + patient(folder_, "chain-slow") + " --device haply:port=" + std::to_string(service.port()) +
                       " --trials 1 --seed 1 --timing-check 0 --data " + folder_.path(),
                   "timeout -s INT 30"),
             "Haply Inverse3");
}

TEST_F(Devices, BothClocksOfAPhantomAreMeasuredByOneCommand) {
  const Ended measured = reach("latency --seconds 0.3 --json", kFakes);
  ASSERT_EQ(measured.exitCode, 0) << measured.err;
  const Json rows = Json::parse(measured.out);
  ASSERT_EQ(rows.size(), 2u);
  for (const Json& row : rows) {
    EXPECT_GT(row["ticks"], 0) << row;
    EXPECT_GT(row["latency_p50_s"], 0) << row;
    EXPECT_GT(row["jitter_max_s"], 0) << row;
  }
}

TEST_F(Devices, EstimatorsOfVelocityAreComparedByOneCommand) {
  const Ended table = reach("velocity --json");
  ASSERT_EQ(table.exitCode, 0) << table.err;
  EXPECT_EQ(Json::parse(table.out).size(), 15u) << "five estimators on three resolutions";
}

}  // namespace
}  // namespace reachlab::test
