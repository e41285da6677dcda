#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <set>

#include "test_paths.h"
#include "tests/cli/program.h"
#include "tests/session/recorded_runs.h"

using namespace reachlab::test;
namespace fs = std::filesystem;

namespace {

std::string logOf(const TemporaryFolder& folder) { return reachlab::session::test::logsIn({.data = folder.path()}).at(0).path(); }

}  // namespace

TEST(Run, WithoutNoiseEveryTrialSucceeds) {
  const TemporaryFolder folder;
  const std::string run = "run chain-moderate --device simulated:noise=0 --trials 5 --seed 1 --fast --data " + folder.path();
  for (const auto& trial : trialLines(printed(run))) EXPECT_EQ(trial.at("outcome"), "success");
}

TEST(Run, PlaysTheHumanReachesAndItsCsvReproducesThePrintedResults) {
  const TemporaryFolder folder;
  const auto trials =
      trialLines(printed("run chain-moderate --device replay:" REACHLAB_SOURCE_DIR "/resources/reaches --fast --data " + folder.path()));
  ASSERT_EQ(trials.size(), 19u);
  const Table table = exportedTrials(logOf(folder));
  ASSERT_EQ(table.rows.size(), 19u);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(table.rows[i][table.column("outcome")], trials[i].at("outcome"));
    EXPECT_EQ(table.at(i, "trial"), static_cast<double>(i + 1));
    if (trials[i].at("outcome") == "failure") {
      EXPECT_EQ(table.rows[i][table.column("reason")], trials[i].at("reason"));
    }
  }
  EXPECT_EQ(reach("replay --check " + logOf(folder)).exitCode, 0);
}

TEST(Run, RunsThatStartAtOnceTakeOneNumberEach) {
  const TemporaryFolder folder;
  std::vector<std::future<std::string>> started;
  for (const char* experiment : {"dingwell", "dingwell", "chain-moderate", "dingwell"})
    started.push_back(std::async(std::launch::async, [&folder, experiment] {
      return printed(std::string("run ") + experiment + " --device simulated --trials 1 --seed 3 --fast --data " + folder.path());
    }));
  for (auto& run : started) run.wait();
  std::set<std::string> numbers;
  for (const auto& entry : fs::directory_iterator(folder / "sourcedata")) {
    const std::string name = entry.path().filename().string();
    numbers.insert(name.substr(name.find("_run-")));
  }
  EXPECT_EQ(numbers.size(), 4u);
  const std::string scans = contentOf(folder / "sub-01/ses-01/sub-01_ses-01_scans.tsv");
  EXPECT_EQ(std::count(scans.begin(), scans.end(), '\n'), 5) << "a header and a row a run\n" << scans;
}

TEST(Run, TheFirstLineNamesTheMethodAndLeavesItsReasonToTheDataset) {
  const TemporaryFolder folder;
  const Ended run = reach("run chain-slow --device simulated --trials 1 --seed 1 --fast --data " + folder.path());
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(run.err, fmt::format("run 1: chain-slow, 1 trial, method exact; recording to {}\n", logOf(folder)));
}

TEST(List, TellsWhatAnExperimentAsks) {
  const std::string out = printed("list experiments");
  for (const char* line : {"point of 1 kg on torus, 1.5 ± 0.6 s\n", "chain of 5 x 0.6 kg on line, 1.35 ± 0.5 s\n",
                           "chain of 5 x 0.6 kg on line, 2 hands, 1.35 ± 0.5 s\n"})
    EXPECT_TRUE(holds(out, line));
}

// As validate says it: the chord stands at right angles to the ellipse at the start.
TEST(Run, SaysThatRoundingDecidesWhichWayTheMassLeaves) {
  const TemporaryFolder folder;
  const std::string ellipse = R"j({"curve": ["0.1*cos(phi)", "0.06*sin(phi)", "0"]})j";
  const std::string file = folder.write("e.json", experimentOn(ellipse, reachFrom("0", "3.141592653589793")));
  EXPECT_TRUE(says(reach("run " + file + " --device simulated --trials 1 --seed 1 --fast --data " + (folder / "data").string()), 0,
                   "rounding decides which way"));
}
