#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
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

Json rowOf(const Json& rows, const std::string& name) {
  for (const Json& row : rows)
    if (row["name"] == name) return row;
  return nullptr;
}

const std::string kTwoOmegas = "forcedimension:0 + forcedimension:1";

class Devices : public InAFolder {
 protected:
  std::string inRealTime(const std::string& experiment, const std::string& device) const {
    return "run " + patient(folder_, experiment) + " --device \"" + device + "\" --trials 1 --seed 1 --timing-check 0 --data " +
           folder_.path();
  }
  const std::string fast_ = " --trials 1 --seed 1 --fast --data " + folder_.path();
};

TEST_F(Devices, ListSaysWhyAVendorsLibraryIsNotThereInTheLoadersWords) {
  const Json listed = printedJson("list devices --json", "LD_LIBRARY_PATH="), phantom = rowOf(listed, "phantom");
  EXPECT_EQ(phantom["present"], false);
  EXPECT_TRUE(holds(phantom["why_not"].get<std::string>(), "libHD.so: cannot open shared object file"));
  EXPECT_TRUE(phantom["max_force_n"].is_null());
  for (const Json& row : listed)
    for (const char* key : {"name", "kind", "present", "why_not", "degrees_of_freedom", "max_force_n", "continuous_force_n", "rate_hz"})
      EXPECT_TRUE(row.contains(key)) << row["name"] << " " << key;
}

TEST_F(Devices, ListShowsWhatIsThereWithTheDevicesOwnLimits) {
  const Json listed = printedJson("list devices --json", kFakes), phantom = rowOf(listed, "phantom");
  EXPECT_EQ(phantom["present"], true) << phantom;
  EXPECT_EQ(phantom["max_force_n"], 3.3);
  EXPECT_EQ(phantom["continuous_force_n"], 0.88);
  EXPECT_EQ(rowOf(listed, "forcedimension:0")["present"], true);
}

TEST_F(Devices, ADeviceThatCannotBeHadIsExitThreeWithItsNameAndTheLoadersWords) {
  EXPECT_TRUE(says(reach("run chain-slow --device phantom --data " + folder_.path(), "LD_LIBRARY_PATH="), 3, "device phantom: libHD.so"));
  EXPECT_TRUE(says(reach("run chain-slow --device phantom:Nowhere --data " + folder_.path(), kFakes), 3, "phantom:Nowhere"));
}

TEST_F(Devices, AnUnknownDeviceIsAWrongUse) {
  EXPECT_EQ(reach("run chain-slow --device theremin --data " + folder_.path()).exitCode, 2);
  EXPECT_EQ(reach("run chain-slow --device virtual:omni,colour=red --data " + folder_.path()).exitCode, 2);
}

TEST_F(Devices, ValidateSaysBeforehandWhatADeviceCannotGive) {
  EXPECT_TRUE(holds(printed("validate chain-fast --device virtual:omni"), "warning  peak force: the reach needs "));
  const Json rows = printedJson("validate chain-fast --device virtual:omni --json");
  EXPECT_EQ(rows[0]["name"], "peak_force");
  EXPECT_EQ(rows[0]["verdict"], "warning");
  EXPECT_EQ(rows[0]["limit"], 3.3);
  EXPECT_GT(rows[0]["asked"], 3.3);
}

TEST_F(Devices, BothOfTwoHandsAreCheckedBeforehand) {
  const std::string hands = "chain-two-hands --device \"virtual:highforce + virtual:omni,scale=0.5\"";
  const std::string checked = printed("validate " + hands);
  for (const char* words : {"fine     hand 1: peak force", "warning  hand 2: workspace", "High Force + virtual PHANToM Omni"})
    EXPECT_TRUE(holds(checked, words));
  const Json rows = printedJson("validate " + hands + " --json");
  EXPECT_EQ(rows.front()["hand"], 1);
  EXPECT_EQ(rows.back()["hand"], 2);
  const Ended run = reach("run " + hands + fast_);
  EXPECT_TRUE(holds(run.err, "warning: hand 2: workspace"));
  EXPECT_FALSE(holds(run.err, "warning: hand 1"));
}

TEST_F(Devices, RunWarnsOfADeviceThatIsTooWeakAndOfNoOther) {
  EXPECT_TRUE(says(reach("run chain-fast --device virtual:omni" + fast_), 0, "warning: peak force: "));
  EXPECT_FALSE(holds(reach("run chain-slow --device virtual:premium15" + fast_).err, "warning: "));
}

TEST_F(Devices, AMappingIsKeptForDeviceAndSubjectAndRecordedWithTheRun) {
  EXPECT_EQ(reach("run chain-slow --device virtual:premium15 --subject 03 --save-mapping" + fast_).exitCode, 2) << "there is none to keep";
  printed("run chain-slow --device virtual:premium15,scale=1.25,wall=yes --subject 03 --save-mapping" + fast_);
  const Json kept = Json::parse(contentOf(folder_ / "sourcedata/mappings/sub-03_virtual-premium15.json"));
  EXPECT_EQ(kept["scale"], 1.25);
  EXPECT_TRUE(holds(reach("run chain-slow --device virtual:premium15 --subject 03" + fast_).err, "mapping of "));
  EXPECT_FALSE(holds(reach("run chain-slow --device virtual:premium15 --subject 04" + fast_).err, "mapping of "));
  const std::string name = folder_.path() + "/sourcedata/sub-03_ses-01_task-chainslow_run-01_log.reach";
  printed("replay " + name + " --check");
  const std::string log = contentOf(name);
  EXPECT_TRUE(holds(log, "port_energy_j"));
  EXPECT_TRUE(holds(log, "\\\"scale\\\":1.25")) << "the mapping is in the recording";
  EXPECT_TRUE(holds(log, "homed")) << "and so are the device's states";
  EXPECT_TRUE(holds(contentOf(folder_ / "sourcedata/sub-04_ses-01_task-chainslow_run-01_log.reach"), "engaged"));
}

TEST_F(Devices, AMappingIsKeptOnlyWithARunAndInAFolderOfAnyName) {
  const std::string data = folder_ / "a, b + c";
  const std::string rest = " --trials 1 --seed 1 --fast --data \"" + data + "\"";
  EXPECT_NE(reach("run no-such --device virtual:omni,scale=2 --save-mapping" + rest).exitCode, 0);
  EXPECT_FALSE(std::filesystem::exists(data));
  printed("run chain-slow --device virtual:omni,scale=2,rotation=0/0/90 --save-mapping" + rest);
  EXPECT_TRUE(holds(reach("run chain-slow --device virtual:omni" + rest).err, "mapping of "));
  EXPECT_TRUE(holds(contentOf(data + "/sourcedata/sub-01_ses-01_task-chainslow_run-02_log.reach"), "\\\"rotation_deg\\\":[0.0,0.0,90.0]"));
}

TEST_F(Devices, OfTwoHandsEachKeepsItsOwnMapping) {
  const std::string rest = " --subject 03" + fast_;
  printed("run chain-two-hands --device \"virtual:premium15,scale=1.25 + virtual:omni,scale=0.5,mirror=x\" --save-mapping" + rest);
  EXPECT_EQ(Json::parse(contentOf(folder_ / "sourcedata/mappings/sub-03_virtual-premium15.json"))["scale"], 1.25);
  EXPECT_EQ(Json::parse(contentOf(folder_ / "sourcedata/mappings/sub-03_virtual-omni.json"))["mirror_x"], true);
  const Ended again = reach("run chain-two-hands --device virtual:premium15 --device virtual:omni" + rest);
  EXPECT_TRUE(holds(again.err, "sub-03_virtual-premium15.json"));
  EXPECT_TRUE(holds(again.err, "sub-03_virtual-omni.json"));
  const std::string log = contentOf(folder_.path() + "/sourcedata/sub-03_ses-01_task-chaintwohands_run-02_log.reach");
  EXPECT_TRUE(holds(log, "\\\"scale\\\":1.25"));
  EXPECT_TRUE(holds(log, "\\\"scale\\\":0.5"));
}

// A scheduler that never calls, calls twice, or stands still for 30 ms each second: the run is done, or is given up in words.
TEST_F(Devices, ASchedulerThatNeverCallsOrTwiceOrLateEndsInWords) {
  for (const char* fault : {"NEVER", "TWICE", "LATE"}) {
    const Ended run = reach("run chain-slow --device phantom --trials 1 --seed 1 --timing-check 0 --data " + folder_.path(),
                            kFakes + " FAKE_HD_" + fault + "=1 timeout -s INT 30");
    EXPECT_TRUE(run.exitCode == 0 || says(run, 3, "device PHANToM")) << fault << ": " << run.exitCode << run.err;
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
  const Ended run = reachUndisturbed(inRealTime("chain-two-hands", kTwoOmegas),
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
  EXPECT_TRUE(holds(run.out, "outcome=interrupted reason=device_lost")) << run.err;
  EXPECT_TRUE(holds(run.err, device) || isDisturbed(run)) << run.err;
}

TEST_F(Devices, APhantomLostInMidTrialInterruptsIt) {
  expectLost(reachUndisturbed(inRealTime("chain-slow", "phantom"), kFakes + " FAKE_HD_LOST_AFTER=2.2 timeout -s INT 30"), "PHANToM");
}

TEST_F(Devices, OneOfTwoOmegasLostInMidTrialInterruptsItAndTakesTheForceFromBoth) {
  const std::string diary = folder_ / "diary";
  expectLost(reachUndisturbed(
                 inRealTime("chain-two-hands", kTwoOmegas),
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
  expectLost(reach(inRealTime("chain-slow", "haply:port=" + std::to_string(service.port())), "timeout -s INT 30"), "Haply Inverse3");
}

TEST_F(Devices, BothClocksOfAPhantomAreMeasuredByOneCommand) {
  const Json rows = printedJson("latency --seconds 0.3 --json", kFakes);
  ASSERT_EQ(rows.size(), 2u);
  for (const Json& row : rows) {
    EXPECT_GT(row["ticks"], 0) << row;
    EXPECT_GT(row["latency_p50_s"], 0) << row;
    EXPECT_GT(row["jitter_max_s"], 0) << row;
  }
}

TEST_F(Devices, AHandleThatTheComputerAsksHasTicksOfAMillisecond) {
  const Json rows = printedJson("latency forcedimension:0 --seconds 0.3 --json", kFakes);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["clock"], "computer");
  EXPECT_LT(rows[0]["jitter_p50_s"], 0.01) << rows;
}

TEST_F(Devices, EstimatorsOfVelocityAreComparedByOneCommand) {
  EXPECT_EQ(printedJson("velocity --json").size(), 15u) << "five estimators on three resolutions";
}

}  // namespace
}  // namespace reachlab::test
