#include "sim/analyze/study.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "sim/analyze/wording.h"
#include "tests/analyze/synthetic.h"

namespace reachlab::analyze {
namespace {

StudyOptions quickOptions() {
  StudyOptions options;
  options.ranking.resamples = 500;
  options.criteria = {predict::Criterion::MinHandJerk, predict::Criterion::MinHandForce, predict::Criterion::MinHandForceChange,
                      predict::Criterion::MinComAcceleration, predict::Criterion::MinHandCrackle};
  return options;
}

std::vector<StudyCondition> threePaces() {
  return {{"slow", chainExperiment(2.26)}, {"moderate", chainExperiment(1.35)}, {"fast", chainExperiment(0.68)}};
}

std::size_t firstOf(const Ranking& ranking, const ConditionResult& result) {
  return static_cast<std::size_t>(result.predictions[ranking.places.front().criterion].criterion);
}

TEST(Study, PlannedByMinimumHandJerkRanksItFirstAloneInEveryPace) {
  const StudyResult study = analyzeStudy(simulatedStudy(threePaces(), predict::Criterion::MinHandJerk, 0, 3, 2, 10, 1), quickOptions());
  for (const ConditionResult& result : study.results) {
    EXPECT_EQ(firstOf(result.handRanking, result), static_cast<std::size_t>(predict::Criterion::MinHandJerk));
    EXPECT_TRUE(result.handRanking.decided());
  }
  ASSERT_FALSE(study.overall.places.empty());
  EXPECT_EQ(study.common[study.overall.places.front().criterion], predict::Criterion::MinHandJerk);
  EXPECT_TRUE(study.overall.decided());
  ASSERT_TRUE(study.overallOverSubjects);
  EXPECT_TRUE(study.overallOverSubjects->decided());
}

TEST(Study, PlannedByForceChangeWithAHandMassRanksThatFirst) {
  StudyOptions options = quickOptions();
  options.handMass = 1.0;
  const StudyResult study = analyzeStudy(simulatedStudy(threePaces(), predict::Criterion::MinHandForceChange, 1.0, 3, 2, 10, 2), options);
  ASSERT_FALSE(study.overall.places.empty());
  EXPECT_EQ(study.common[study.overall.places.front().criterion], predict::Criterion::MinHandForceChange);
  EXPECT_TRUE(study.overall.decided());
}

TEST(Study, OfTheParallelObjectSaysWhichCriteriaCannotBeToldApart) {
  // Without a hand mass criteria (4) and (6) are one prediction: their costs differ by the factor M^2 alone.
  const std::vector<StudyCondition> parallel{{"parallel", parallelExperiment(2.5)}};
  const StudyResult study = analyzeStudy(simulatedStudy(parallel, predict::Criterion::MinComAcceleration, 0, 2, 1, 10, 3), quickOptions());
  const Ranking& ranking = study.results[0].handRanking;
  EXPECT_FALSE(ranking.decided());
  EXPECT_FALSE(ranking.places[1].apartFromFirst);
  EXPECT_NE(describeRanking(ranking, criteriaOf(study.results[0])).find("cannot be told apart from"), std::string::npos);

  const StudyResult jerk = analyzeStudy(simulatedStudy(parallel, predict::Criterion::MinHandJerk, 0, 2, 1, 10, 3), quickOptions());
  const Ranking& behind = jerk.results[0].handRanking;
  EXPECT_EQ(firstOf(behind, jerk.results[0]), static_cast<std::size_t>(predict::Criterion::MinHandJerk));
  EXPECT_NE(describeRanking(behind, criteriaOf(jerk.results[0])).find("these cannot be told apart"), std::string::npos);
}

TEST(Study, CountsSuccessByDayAndLeavesPracticeOut) {
  StudyInput input = simulatedStudy({{"moderate", chainExperiment(1.35)}}, predict::Criterion::MinHandJerk, 0, 2, 2, 10, 4);
  for (TrialData& trial : input.trials)
    if (trial.key.trial == 1) trial.practice = true;
  input.trials[3].result = {};
  input.trials[3].result.outcome = trial::Outcome::Aborted;
  input.trials[3].result.reason = trial::Reason::NoOnset;
  const StudyInput copy = input;
  const StudyResult study = analyzeStudy(std::move(input), quickOptions());
  ASSERT_EQ(study.success.size(), 4u);
  EXPECT_EQ(study.success[0].subject, "S1");
  EXPECT_EQ(study.success[0].day, 1);
  EXPECT_EQ(study.success[0].trials, 8u);     // ten less one practice and one aborted
  EXPECT_EQ(study.success[0].successes, 6u);  // trials 5 and 10 failed
  EXPECT_EQ(study.results[0].counts.practice, 4u);
  EXPECT_EQ(study.results[0].counts.aborted, 1u);
  EXPECT_EQ(study.results[0].exclusions.at("practice"), 4u);

  StudyOptions with = quickOptions();
  with.includePractice = true;
  EXPECT_EQ(analyzeStudy(copy, with).success[0].trials, 9u);
}

TEST(Study, LearningPointsNeverSpanTwoSessions) {
  const StudyResult study =
      analyzeStudy(simulatedStudy({{"m", chainExperiment(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 2, 15, 5), quickOptions());
  ASSERT_EQ(study.learning.size(), 4u);  // 10 + 5 trials on each of two days
  EXPECT_EQ(study.learning[1].firstTrial, 11);
  EXPECT_EQ(study.learning[1].lastTrial, 15);
  EXPECT_EQ(study.learning[2].firstTrial, 16);
  EXPECT_EQ(study.learning[2].session, "02");
}

TEST(Study, SeriesErrorIsTheRootOfTheMeanOverAllSamples) {
  const StudyResult study =
      analyzeStudy(simulatedStudy({{"m", chainExperiment(1.35)}}, predict::Criterion::MinHandJerk, 0, 2, 2, 10, 6), quickOptions());
  ASSERT_EQ(study.series.size(), 4u);
  double sum = 0;
  int n = 0;
  for (const StudyTrial& t : study.trials)
    if (t.used() && t.key.subject == "S1" && t.key.session == "01") sum += t.handError[0] * t.handError[0], ++n;
  EXPECT_NEAR(study.series[0].handError[0], std::sqrt(sum / n), 1e-15);
}

TEST(Study, BearsOneTrialNoSuccessAndNoTrial) {
  const std::vector<StudyCondition> conditions{{"m", chainExperiment(1.35)}};
  StudyInput one = simulatedStudy(conditions, predict::Criterion::MinHandJerk, 0, 1, 1, 1, 7);
  StudyInput failed = one;
  failed.trials[0].result.outcome = trial::Outcome::Failure;
  StudyInput empty;
  empty.conditions = conditions;
  StudyInput still = one;
  for (Vec3& p : still.trials[0].hand) p = {};

  EXPECT_EQ(analyzeStudy(one, quickOptions()).results[0].used, 1u);
  EXPECT_FALSE(analyzeStudy(one, quickOptions()).overall.decided());
  for (StudyInput* input : {&empty, &still}) {
    const StudyResult study = analyzeStudy(*input, quickOptions());
    EXPECT_EQ(study.results[0].used, 0u);
    EXPECT_TRUE(study.overall.places.empty());
    EXPECT_FALSE(study.results[0].predictions.empty());
  }
  // Failures alone are described, but decide nothing over all.
  const StudyResult study = analyzeStudy(failed, quickOptions());
  EXPECT_TRUE(study.results[0].onlyFailures);
  EXPECT_EQ(study.results[0].used, 1u);
  EXPECT_TRUE(study.overall.places.empty());
}

TEST(Study, RefusesOptionsOutOfRange) {
  StudyOptions options = quickOptions();
  options.measure.onset.percent = 0;
  EXPECT_THROW(analyzeStudy({}, options), UsageError);
  options = quickOptions();
  options.ranking.resamples = 10;
  EXPECT_THROW(analyzeStudy({}, options), UsageError);
}

TEST(Measures, OfAKnownMovementAreWhatTheyShouldBe) {
  const auto plan = predict::predict(chainExperiment(1.35), predict::Criterion::MinHandJerk);
  std::mt19937_64 random(1);
  const TrialData trial = followPlan(*plan, {0, 0, 0}, random);
  const TrialSignals signals = computeSignals(trial, {});
  const TrialMeasures m = computeMeasures(trial, signals);
  EXPECT_NEAR(m.peakSpeed, plan->handPeak, 0.003 * plan->handPeak);  // what the 10 Hz filter takes off the top
  EXPECT_NEAR(m.timeToPeakPercent, 50, 0.5);
  EXPECT_NEAR(m.symmetryRatio, 1, 0.02);
  EXPECT_NEAR(m.pathLength, 0.2, 0.002);
  EXPECT_EQ(m.speedPeaks, 1);
  EXPECT_NEAR(m.movementTime, 1.35, 1e-12);
  EXPECT_LT(m.objectEndpointError, 1e-9);
  EXPECT_LT(m.objectOvershoot, 1e-9);
  EXPECT_NEAR(m.reactionTime, m.onset - 0.1, 1e-12);
  EXPECT_LT(m.handEndpointError, 0.002);  // offset is at 5 % of the peak, just before the end
}

}  // namespace
}  // namespace reachlab::analyze
