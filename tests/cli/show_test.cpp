// `reach show`: what was recorded is told again as it was, and a trial's samples are those of the export.
#include <gtest/gtest.h>

#include <regex>

#include <algorithm>
#include <filesystem>

#include "tests/cli/program.h"
#include "tests/record/made_run.h"

using namespace reachlab::test;
using Json = nlohmann::json;

namespace {

struct Recorded {
  TemporaryFolder folder;
  std::string data = (folder / "data").string();
  std::string log = data + "/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach";
  std::string run = printed("run chain-moderate --device simulated --trials 3 --seed 1 --fast --data " + data);
};

}  // namespace

TEST(Show, TellsTheTrialsAsTheyWereJudged) {
  const Recorded recorded;
  const Json runs = printedJson("show --json " + recorded.log);
  ASSERT_EQ(runs.size(), 1u);
  ASSERT_EQ(runs[0]["trials"].size(), 3u);
  for (const Json& trial : runs[0]["trials"]) {
    const std::string line = "trial=" + std::to_string(trial["trial"].get<int>()) + " outcome=" + trial["outcome"].get<std::string>();
    EXPECT_TRUE(holds(recorded.run, line));
    EXPECT_GT(trial["peak_hand_speed_m_per_s"].get<double>(), 0);
  }
  EXPECT_EQ(runs[0]["state"], "whole");
}

TEST(Show, GivesATrialSampleBySample) {
  const Recorded recorded;
  const std::string odd = recorded.log.substr(0, recorded.log.rfind('/')) + "/\xff_log.reach";
  std::filesystem::copy(recorded.log, odd);
  EXPECT_EQ(printedJson("show --json " + odd).size(), 1u) << "a name that is no UTF-8";
  const Json trial = printedJson("show --json --trial 2 " + recorded.log);
  EXPECT_EQ(trial["trial"], 2);
  const auto time = trial["samples"]["since_onset_s"].get<std::vector<double>>();
  const auto speed = trial["samples"]["hand_speed_m_per_s"].get<std::vector<double>>();
  ASSERT_EQ(time.size(), speed.size());
  ASSERT_GT(time.size(), 50u);
  for (std::size_t i = 1; i < time.size(); ++i) EXPECT_NEAR(time[i] - time[i - 1], 0.01, 1e-12);  // 100 Hz
  // The samples are every tenth of the ticks that the peak was taken over.
  const double peak = *std::max_element(speed.begin(), speed.end());
  EXPECT_LE(peak, trial["peak_hand_speed_m_per_s"].get<double>());
  EXPECT_GT(peak, 0.9 * trial["peak_hand_speed_m_per_s"].get<double>());
}

TEST(Show, DrawsATrial) {
  const Recorded recorded;
  const std::string figure = (recorded.folder / "trial.svg").string();
  printed("show " + recorded.log + " --trial 1 --figure " + figure);
  EXPECT_TRUE(holds(contentOf(figure), "<svg"));
}

// The readable logs are told or exported. What is left out is named, and a script sees it.
TEST(Show, AndExportNameALogThatCannotBeRead) {
  const Recorded recorded;
  const std::string other = recorded.data + "/sourcedata/sub-02_ses-01_task-chainmoderate_run-01_log.reach";
  std::ofstream(other) << "no log";
  for (const std::string command : {"show ", "show --json ", "export --format csv "}) {
    const Ended ended = reach(command + recorded.data);
    EXPECT_TRUE(says(ended, 3, other)) << command;
    EXPECT_TRUE(holds(ended.err, "1 of 2 logs")) << command;
    EXPECT_NE(ended.out, "") << command;
  }
  EXPECT_EQ(reach("show " + other).exitCode, 2) << "alone it is a bad file";
}

TEST(Show, CountsCatchTrialsApart) {
  const TemporaryFolder folder;
  const std::string plan = folder.write("plan.json", R"({ "schema_version": 1, "trials": 6, "foreperiod_s": [0.1, 0.2], "catch_share": 0.34,
    "blocks": [{ "experiment": "chain-slow" }] })");
  printed("run " + plan + " --device simulated:noise=0 --seed 1 --fast --data " + (folder / "data").string());
  int caught = 0;
  const Json runs = printedJson("show --json " + (folder / "data").string());
  for (const Json& trial : runs[0]["trials"]) caught += trial["catch_trial"].get<bool>() ? 1 : 0;
  ASSERT_EQ(caught, 2);
  EXPECT_TRUE(std::regex_search(printed("show " + (folder / "data").string()), std::regex("recorded +6 +2 +4 ")));
}

TEST(Export, RefusesTwoLogsWithTheLabelsOfOneRun) {
  const TemporaryFolder folder;
  for (const char* seed : {"1", "2"})
    printed(std::string("run chain-slow --device simulated --fast --seed ") + seed + " --data " + (folder / seed).string());
  std::filesystem::create_directories(folder / "both/sourcedata");
  for (const char* seed : {"1", "2"})
    std::filesystem::copy_file(folder / (std::string(seed) + "/sourcedata/sub-01_ses-01_task-chainslow_run-01_log.reach"),
                               folder / (std::string("both/sourcedata/sub-0") + seed + "_ses-01_task-chainslow_run-01_log.reach"));
  EXPECT_TRUE(
      says(reach("export " + (folder / "both").string() + " --format csv"), 2, "are both recorded as sub-01_ses-01_task-chainslow_run-01"));
}

TEST(Export, LeavesOutALogThatIsBeingRecordedInto) {
  const Recorded recorded;
  reachlab::record::RunConfiguration configuration = reachlab::record::madeConfiguration();
  configuration.run = configuration.firstRun = 2;
  const std::string open = recorded.data + "/sourcedata/sub-01_ses-01_task-made_run-02_log.reach";
  const std::string table = recorded.data + "/sub-01/ses-01/motion/sub-01_ses-01_task-made_tracksys-haptic_run-02_motion.tsv";
  reachlab::record::MadeRecording recording(open, configuration);
  recording.until(reachlab::record::MadeRun::kTicksPerTrial);
  for (const char* format : {" --format bids", " --format csv"})
    EXPECT_TRUE(says(reach("export " + recorded.data + format), 0, open + ": is being recorded into; left out\n"));
  EXPECT_FALSE(std::filesystem::exists(table));
  EXPECT_TRUE(says(reach("export --format bids " + open), 3, open + ": is being recorded into\n"));
  EXPECT_EQ(reach("show " + open).exitCode, 0);
  recording.recorder.close();
}

TEST(Show, RefusesWhatIsNotThere) {
  const Recorded recorded;
  EXPECT_TRUE(says(reach("show --trial 4 " + recorded.log), 2, "allowed: 1 to 3"));
  EXPECT_EQ(reach("show " + recorded.log + " --figure x.svg").exitCode, 2);
  EXPECT_EQ(reach("show /nowhere").exitCode, 2);
}
