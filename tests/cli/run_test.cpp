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

class Run : public InAFolder {
 protected:
  std::string recordedLog() const { return reachlab::session::test::logsIn({.data = folder_.path()}).at(0).path(); }
};

TEST_F(Run, WithoutNoiseEveryTrialSucceeds) {
  const std::string run = "run chain-moderate --device simulated:noise=0 --trials 5 --seed 1 --fast --data " + folder_.path();
  for (const auto& trial : trialLines(printed(run))) EXPECT_EQ(trial.at("outcome"), "success");
}

TEST_F(Run, PlaysTheHumanReachesAndItsCsvReproducesThePrintedResults) {
  const auto trials =
      trialLines(printed("run chain-moderate --device replay:" REACHLAB_SOURCE_DIR "/resources/reaches --fast --data " + folder_.path()));
  ASSERT_EQ(trials.size(), 19u);
  const Table table = exportedTrials(recordedLog());
  ASSERT_EQ(table.rows.size(), 19u);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_EQ(table.rows[i][table.column("outcome")], trials[i].at("outcome"));
    EXPECT_EQ(table.at(i, "trial"), static_cast<double>(i + 1));
    if (trials[i].at("outcome") == "failure") {
      EXPECT_EQ(table.rows[i][table.column("reason")], trials[i].at("reason"));
    }
  }
  EXPECT_EQ(reach("replay --check " + recordedLog()).exitCode, 0);
}

TEST_F(Run, RunsThatStartAtOnceTakeOneNumberEach) {
  std::vector<std::future<std::string>> started;
  for (const char* experiment : {"dingwell", "dingwell", "chain-moderate", "dingwell"})
    started.push_back(std::async(std::launch::async, [this, experiment] {
      return printed(std::string("run ") + experiment + " --device simulated --trials 1 --seed 3 --fast --data " + folder_.path());
    }));
  for (auto& run : started) run.wait();
  std::set<std::string> numbers;
  for (const auto& entry : fs::directory_iterator(folder_ / "sourcedata")) {
    const std::string name = entry.path().filename().string();
    numbers.insert(name.substr(name.find("_run-")));
  }
  EXPECT_EQ(numbers.size(), 4u);
  const std::string scans = contentOf(folder_ / "sub-01/ses-01/sub-01_ses-01_scans.tsv");
  EXPECT_EQ(std::count(scans.begin(), scans.end(), '\n'), 5) << "a header and a row a run\n" << scans;
}

TEST_F(Run, TheFirstLineNamesTheMethodAndLeavesItsReasonToTheDataset) {
  const Ended run = reach("run chain-slow --device simulated --trials 1 --seed 1 --fast --data " + folder_.path());
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(run.err, fmt::format("run 1: chain-slow, 1 trial, method exact; recording to {}\n", recordedLog()));
}

TEST(List, TellsWhatAnExperimentAsks) {
  const std::string out = printed("list experiments");
  for (const char* line : {"point of 1 kg on torus, 1.5 ± 0.6 s\n", "chain of 5 x 0.6 kg on line, 1.35 ± 0.5 s\n",
                           "chain of 5 x 0.6 kg on line, 2 hands, 1.35 ± 0.5 s\n"})
    EXPECT_TRUE(holds(out, line));
}

// As validate says it: the chord stands at right angles to the ellipse at the start.
TEST_F(Run, SaysThatRoundingDecidesWhichWayTheMassLeaves) {
  const std::string ellipse = R"j({"curve": ["0.1*cos(phi)", "0.06*sin(phi)", "0"]})j";
  const std::string file = folder_.write("e.json", experimentOn(ellipse, reachFrom("0", "3.141592653589793")));
  EXPECT_TRUE(
      says(reach("run " + file + " --device simulated --trials 1 --seed 1 --fast --data " + data_), 0, "rounding decides which way"));
}

TEST_F(Run, OfAHandThatIsNeverAtTheStartEnds) {
  const Ended ended = reach("run chain-fast --device virtual:omni,scale=0.5 --trials 3 --seed 1 --fast --data " + folder_.path());
  EXPECT_TRUE(ended.exitCode == 0 || ended.exitCode == 2 || ended.exitCode == 4) << ended.err;
  for (const auto& trial : trialLines(ended.out)) EXPECT_NE(trial.at("outcome"), "interrupted");
}

// The criterion of this hand is known. Where its mass was not among the tried ones, another criterion was named.
TEST_F(Run, OfAHeavyHandIsNotTakenForAnotherCriterion) {
  for (const std::string mass : {"3", "4"}) {
    const std::string data = folder_ / mass;
    printed("run dingwell --device simulated:criterion=min-hand-force,hand-mass=" + mass + " --trials 60 --seed 7 --fast --data " + data);
    const std::string all = printed("analyze " + data);
    EXPECT_TRUE(holds(all.substr(0, all.find('\n')), "follow (4) min-hand-force")) << mass << " kg";
  }
}
