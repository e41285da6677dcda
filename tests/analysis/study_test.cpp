#include "analysis/study.h"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "analysis/report/figures.h"
#include "analysis/report/wording.h"
#include "analysis/tables.h"
#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "tests/analysis/synthetic.h"

namespace reachlab::analysis {
namespace {

StudyOptions quickOptions() {
  StudyOptions options;
  options.criteria = {predict::Criterion::MinHandJerk, predict::Criterion::MinHandForce, predict::Criterion::MinHandForceChange,
                      predict::Criterion::MinComAcceleration, predict::Criterion::MinHandCrackle};
  return options;
}

std::string followed(const Conclusion& c, const std::vector<std::vector<predict::Criterion>>& names) {
  return c.follows ? nameOfCandidate(names[*c.follows]) : "undecided: " + std::string(nameOf(c.reason));
}

TEST(Study, OfFiveSubjectsPlannedByMinimumHandJerkIsDecidedForIt) {
  const std::vector<StudyCondition> paces{{"slow", compiledChain(2.26)}, {"moderate", compiledChain(1.35)}};
  const StudyResult study = analyzeStudy(simulatedStudy(paces, predict::Criterion::MinHandJerk, 0, 5, 1, 15, 1), quickOptions());
  EXPECT_EQ(followed(study.overall, study.common), "min-hand-jerk") << describeConclusion(study.overall, study.common);
  EXPECT_TRUE(study.overall.overSubjects);
  EXPECT_EQ(study.overall.subjects, 5u);
}

TEST(Study, PlannedByForceChangeWithAHandMassIsDecidedForThatAndFindsTheMass) {
  const StudyResult study = analyzeStudy(
      simulatedStudy({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandForceChange, 1.0, 5, 1, 25, 2), quickOptions());
  EXPECT_EQ(followed(study.overall, study.common), "min-hand-force-change") << describeConclusion(study.overall, study.common);
  for (const FitRow& row : fitRows(study)) {
    if (row.criterion == "min-hand-force-change") {
      EXPECT_EQ(row.handMass, 1.0) << row.subject;
    }
  }
}

TEST(Study, NamesForceAndCentreOfMassTogetherBecauseTheyPredictTheSame) {
  const StudyResult study = analyzeStudy(simulatedStudy({{"parallel", experiment::CompiledExperiment(parallelExperiment(2.5))}},
                                                        predict::Criterion::MinHandForce, 0.5, 1, 1, 15, 3),
                                         quickOptions());
  const auto names = candidatesOf(study.results[0]);
  ASSERT_EQ(names.size(), 5u);  // (1), (4) and (6), (5), (3h), the reference
  const std::vector<predict::Criterion> both{predict::Criterion::MinHandForce, predict::Criterion::MinComAcceleration};
  EXPECT_NE(std::find(names.begin(), names.end(), both), names.end());
  EXPECT_NE(describeCandidate(both).find("which predict the same"), std::string::npos);
}

TEST(Study, OfOneSubjectSaysNothingAboutOtherPeople) {
  const StudyResult study =
      analyzeStudy(simulatedStudy({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandForce, 1, 1, 1, 30, 3), quickOptions());
  EXPECT_FALSE(study.overall.overSubjects);
  EXPECT_EQ(followed(study.overall, study.common), "min-hand-force");
  EXPECT_NE(describeConclusion(study.overall, study.common).find("nothing follows about other people"), std::string::npos);
}

// People whose hands ignore the object, and of whom it is not asked whether they succeeded.
TEST(Study, OfHandsThatIgnoreTheObjectIsNeverConcludedUpon) {
  const auto blind = [](const experiment::Experiment& e) {
    return std::make_unique<ObjectBlindPlan>(e.task->duration, e.object.masses.size());
  };
  for (const auto& e :
       {chainExperiment(1.35), parallelExperiment(2.5), lineExperiment(experiment::ObjectKind::Chain, {3}, {}, 120, 1.35)}) {
    const StudyResult study =
        analyzeStudy(simulatedStudy({{"blind", experiment::CompiledExperiment(e)}}, blind, 5, 1, 15, 11), quickOptions());
    EXPECT_EQ(followed(study.overall, study.common), "undecided: reference") << describeConclusion(study.overall, study.common);
    EXPECT_TRUE(study.overall.referenceFirst);
    for (const PersonResult& person : study.people) EXPECT_FALSE(person.follows) << person.subject;
  }
}

TEST(Study, OfTwoCampsIsNeverDecided) {
  const std::vector<StudyCondition> moderate{{"moderate", compiledChain(1.35)}};
  StudyInput camps = simulatedStudy(moderate, predict::Criterion::MinHandJerk, 0, 3, 1, 20, 1);
  StudyInput others = simulatedStudy(moderate, predict::Criterion::MinHandForceChange, 1, 2, 1, 20, 2);
  for (TrialData& trial : others.trials) {
    trial.key.subject = "T" + trial.key.subject;
    camps.trials.push_back(std::move(trial));
    camps.conditionOf.push_back(0);
  }
  const StudyResult study = analyzeStudy(std::move(camps), quickOptions());
  EXPECT_EQ(study.overall.subjects, 5u);
  EXPECT_FALSE(study.overall.decided()) << describeConclusion(study.overall, study.common);
}

TEST(Study, OfTooFewTrialsConcludesNothing) {
  const StudyResult study =
      analyzeStudy(simulatedStudy({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 5, 1, 10, 3), quickOptions());
  EXPECT_EQ(followed(study.overall, study.common), "undecided: too_few_trials");  // 8 successes each
}

TEST(Study, CountsSuccessByDayAndLeavesPracticeOut) {
  StudyInput input = simulatedStudy({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 2, 2, 10, 4);
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
      analyzeStudy(simulatedStudy({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 2, 15, 5), quickOptions());
  ASSERT_EQ(study.learning.size(), 4u);  // 10 + 5 trials on each of two days
  EXPECT_EQ(study.learning[1].firstTrial, 11);
  EXPECT_EQ(study.learning[1].lastTrial, 15);
  EXPECT_EQ(study.learning[2].firstTrial, 16);
  EXPECT_EQ(study.learning[2].session, "02");
}

TEST(Study, DrawsAGroupOfTrialsInItsMiddleAndSaysWhatTheAxesAre) {
  for (const int subjects : {1, 3}) {  // three are drawn with what is typical of them
    const StudyResult study =
        analyzeStudy(simulatedStudy({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, subjects, 1, 15, 5), quickOptions());
    const NamedFigure learning = learningFigure(study);
    ASSERT_EQ(learning.figure.panels.size(), 1u);
    const figure::Panel& panel = learning.figure.panels[0];
    EXPECT_EQ(panel.x.label, "Trial");
    EXPECT_EQ(panel.y.label, "Success (%)");
    EXPECT_EQ(panel.series.size(), subjects == 1 ? 1u : 4u);
    for (const figure::Series& series : panel.series) EXPECT_EQ(series.x, (std::vector<double>{5.5, 13})) << "of 1 to 10 and 11 to 15";
  }
}

TEST(Study, WritesEachTableWithAsManyCellsInARowAsColumnsAndWhatItConcluded) {
  const StudyResult study =
      analyzeStudy(simulatedStudy({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 2, 2, 12, 1), quickOptions());
  std::map<std::string, std::string> tables;
  writeTables(study, [&](const std::string& name, std::string_view piece) { tables[name] += piece; });
  std::map<std::string, std::vector<std::vector<std::string>>> rows;
  for (const auto& [name, text] : tables) {
    EXPECT_TRUE(text.ends_with('\n')) << name;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line + ',');
      rows[name].emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) rows[name].back().push_back(cell);
      EXPECT_EQ(rows[name].back().size(), rows[name].front().size()) << name << ": " << line;
    }
  }
  EXPECT_EQ(rows["trials.csv"].size(), 1 + study.trials.size());
  EXPECT_EQ(rows["success_table.csv"].size(), 1 + study.success.size());
  EXPECT_EQ(rows["learning.csv"].size(), 1 + study.learning.size());
  ASSERT_TRUE(study.overall.best);
  std::vector<std::string> best;
  for (const auto& row : rows["conclusions.csv"])
    if (row.at(0) == "all" && row.at(7) == "yes") best.push_back(row.at(2));
  EXPECT_EQ(best, std::vector<std::string>{nameOfCandidate(study.common[*study.overall.best])});
}

TEST(Study, SeriesErrorIsTheRootOfTheMeanOverAllSamples) {
  const StudyResult study =
      analyzeStudy(simulatedStudy({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 2, 2, 10, 6), quickOptions());
  ASSERT_EQ(study.series.size(), 4u);
  double sum = 0;
  int n = 0;
  for (const StudyTrial& t : study.trials)
    if (t.used() && t.key.subject == "S1" && t.key.session == "01") sum += t.paperError[0] * t.paperError[0], ++n;
  EXPECT_NEAR(study.series[0].handError[0], std::sqrt(sum / n), 1e-15);
}

TEST(Study, BearsOneTrialNoSuccessAndNoTrial) {
  const std::vector<StudyCondition> conditions{{"m", compiledChain(1.35)}};
  StudyInput one = simulatedStudy(conditions, predict::Criterion::MinHandJerk, 0, 1, 1, 1, 7);
  StudyInput failed = one;
  failed.trials[0].result.outcome = trial::Outcome::Failure;
  StudyInput empty;
  empty.conditions = conditions;
  StudyInput still = one;
  for (Vec3& p : still.trials[0].hand) p = {};

  EXPECT_EQ(analyzeStudy(one, quickOptions()).results[0].used, 1u);
  const std::string caption = paperFigure(analyzeStudy(one, quickOptions()), 0).caption;
  EXPECT_NE(caption.find("Thin: 1 trial, "), std::string::npos) << caption;
  EXPECT_NE(paperFigure(analyzeStudy(empty, quickOptions()), 0).caption.find("predictions only"), std::string::npos);
  EXPECT_FALSE(analyzeStudy(one, quickOptions()).overall.decided());
  for (StudyInput* input : {&empty, &still}) {
    const StudyResult study = analyzeStudy(*input, quickOptions());
    EXPECT_EQ(study.results[0].used, 0u);
    EXPECT_FALSE(study.overall.best);
    EXPECT_FALSE(study.results[0].predictions.empty());
  }
  // Failures alone are described, but decide nothing over all.
  const StudyResult study = analyzeStudy(failed, quickOptions());
  EXPECT_TRUE(study.results[0].onlyFailures);
  EXPECT_EQ(study.results[0].used, 1u);
  EXPECT_FALSE(study.overall.best);
}

TEST(Study, RefusesOptionsOutOfRange) {
  StudyOptions options = quickOptions();
  options.measure.onset.percent = 0;
  EXPECT_THROW(analyzeStudy({}, options), FaultError);
  options = quickOptions();
  options.handMasses = {};
  EXPECT_THROW(analyzeStudy({}, options), FaultError);
}

TEST(Study, CountsInvalidTimingApartAndLeavesItOut) {
  StudyInput input = simulatedStudy({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 1, 6, 4);
  input.trials[0].result.reason = trial::Reason::Timing;
  input.trials[0].result.outcome = trial::Outcome::Interrupted;
  input.trials[1].goTime = 1.0;  // the hand leaves at 0.4 s
  const StudyResult study = analyzeStudy(std::move(input), quickOptions());
  EXPECT_EQ(study.results[0].counts.invalidTiming, 1u);
  EXPECT_EQ(study.results[0].counts.beforeGo, 1u);
  EXPECT_EQ(study.trials[0].exclusion, "invalid timing");
  EXPECT_TRUE(std::isnan(study.trials[1].measures.reactionTime));
  const std::string words = describeCounts(study.results[0]);
  EXPECT_NE(words.find("invalid timing"), std::string::npos) << words;
  EXPECT_NE(words.find("before the go signal"), std::string::npos) << words;
}

TEST(Study, OfAClosedCurveTravelledTheOtherWayScoresTheWayThatTheHandWent) {
  StudyInput input = simulatedStudy({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 1, 4, 4);
  const StudyInput straight = input;
  for (TrialData& trial : input.trials) {
    trial.closed = true;
    trial.along = {{-1, 0, 0}};  // what the task calls forward
  }
  const StudyResult backwards = analyzeStudy(std::move(input), quickOptions()), forwards = analyzeStudy(straight, quickOptions());
  EXPECT_EQ(backwards.results[0].counts.otherWay, 4u);
  EXPECT_EQ(backwards.trials[0].paperError, forwards.trials[0].paperError);
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

// Where the recording does not say what the force was. One that grows by 1 N a second: its mean is what it is half-way.
TEST(Measures, OfAForceAreOverTheMovementAlone) {
  const auto plan = predict::predict(chainExperiment(1.35), predict::Criterion::MinHandJerk);
  std::mt19937_64 random(1);
  TrialData trial = followPlan(*plan, {0, 0, 0}, random);
  for (std::size_t i = 0; i < trial.force.size(); ++i) trial.force[i] = static_cast<double>(i) / trial.rate;
  const TrialMeasures m = computeMeasures(trial, computeSignals(trial, {}));
  EXPECT_NEAR(m.meanForce, 0.5 * (m.onset + m.offset), 0.01) << "within a sample";
}

}  // namespace
}  // namespace reachlab::analysis
