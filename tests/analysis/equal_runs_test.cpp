#include "analysis/trials/equal_runs.h"

#include <gtest/gtest.h>

namespace reachlab::analysis {
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

// Whatever is told of a movement tells it from another: to the last bit, and no more than that.
TEST(EqualRuns, AnyMeasureOfATrialTellsItApart) {
  using Change = void (*)(record::RecordedTrial&);
  const Change changes[] = {[](record::RecordedTrial& t) { t.result.outcome = trial::Outcome::Failure; },
                            [](record::RecordedTrial& t) { t.result.reason = trial::Reason::Velocity; },
                            [](record::RecordedTrial& t) { t.planned.catchTrial = true; },
                            [](record::RecordedTrial& t) { ++t.result.onsetTick; },
                            [](record::RecordedTrial& t) { ++t.result.endTick; },
                            [](record::RecordedTrial& t) { t.peakHandSpeed = 0.3; },
                            [](record::RecordedTrial& t) { t.handPathLength = 0.2; },
                            [](record::RecordedTrial& t) { t.peakForce = 1; },
                            [](record::RecordedTrial& t) { t.meanForce = 1; }};
  for (const Change change : changes) {
    record::RecordedTrial first = trialWith(0.25), second = trialWith(0.25);
    EXPECT_EQ(countRepeats({first, second}), 1);
    change(second);
    EXPECT_EQ(countRepeats({first, second}), 0);
    EXPECT_EQ(countRepeats({second, first, second}), 1);
  }
  record::RecordedTrial slow = trialWith(0), never = trialWith(0.3);
  never.result.onsetTick = 0;
  EXPECT_EQ(countRepeats({slow, slow}), 0) << "a hand that did not move repeats nothing";
  EXPECT_EQ(countRepeats({never, never}), 0);
}

}  // namespace
}  // namespace reachlab::analysis
