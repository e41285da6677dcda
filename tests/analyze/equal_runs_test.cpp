#include "sim/analyze/equal_runs.h"

#include <gtest/gtest.h>

namespace reachlab::analyze {
namespace {

record::RecordedTrial trialWith(double peakSpeed, std::uint64_t start = 100) {
  record::RecordedTrial trial;
  trial.startTick = start;
  trial.result.outcome = trial::Outcome::Success;
  trial.result.onsetTick = start + 200;
  trial.result.endTick = start + 1500;
  trial.peakHandSpeed = peakSpeed;
  return trial;
}

TEST(EqualRuns, ARunRecordedAgainIsFoundWheneverItBegan) {
  EqualRuns runs;
  record::RunConfiguration c;
  EXPECT_EQ(runs.twinOf("a", c, {trialWith(0.3), trialWith(0.31, 2000)}), "");
  EXPECT_EQ(runs.twinOf("b", c, {trialWith(0.3, 150), trialWith(0.31, 2900)}), "a");
}

TEST(EqualRuns, AnotherSubjectExperimentOrMovementIsAnotherRun) {
  EqualRuns runs;
  record::RunConfiguration c;
  EXPECT_EQ(runs.twinOf("a", c, {trialWith(0.3)}), "");
  EXPECT_EQ(runs.twinOf("b", c, {trialWith(0.3000000000000001)}), "");
  EXPECT_EQ(runs.twinOf("c", c, {trialWith(0.3), trialWith(0.3)}), "");
  for (std::string record::RunConfiguration::*label : {&record::RunConfiguration::subject, &record::RunConfiguration::session,
                                                       &record::RunConfiguration::experimentText, &record::RunConfiguration::condition}) {
    record::RunConfiguration other;
    other.*label = "other";
    EXPECT_EQ(runs.twinOf("d", other, {trialWith(0.3)}), "");
  }
}

TEST(EqualRuns, RunsInWhichNobodyMovedAreNotCompared) {
  EqualRuns runs;
  record::RecordedTrial still;
  EXPECT_EQ(runs.twinOf("a", {}, {still}), "");
  EXPECT_EQ(runs.twinOf("b", {}, {still}), "");
}

TEST(EqualRuns, RepeatsInsideARunAreCounted) {
  EXPECT_EQ(countRepeats({trialWith(0.3), trialWith(0.3, 2000), trialWith(0.4), trialWith(0.3, 9000)}), 2);
  EXPECT_EQ(countRepeats({trialWith(0.3), trialWith(0.4)}), 0);
}

}  // namespace
}  // namespace reachlab::analyze
