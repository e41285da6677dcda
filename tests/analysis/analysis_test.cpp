#include "analysis/analysis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/report/figures.h"
#include "analysis/report/wording.h"
#include "base/fault.h"
#include "tests/analysis/synthetic.h"
#include "tests/analysis/written_tables.h"

namespace reachlab::analysis {
namespace {

AnalysisOptions quickOptions() {
  AnalysisOptions options;
  options.criteria = {predict::Criterion::MinHandJerk, predict::Criterion::MinHandForce, predict::Criterion::MinHandForceChange,
                      predict::Criterion::MinComAcceleration, predict::Criterion::MinHandCrackle};
  return options;
}

std::string followed(const Conclusion& c, const std::vector<std::vector<predict::Criterion>>& names) {
  return c.follows ? nameOfCandidate(names[*c.follows]) : "undecided: " + std::string(nameOf(c.reason));
}

TEST(Study, OfFiveSubjectsPlannedByMinimumHandJerkIsDecidedForIt) {
  const std::vector<Condition> paces{{"slow", compiledChain(2.26)}, {"moderate", compiledChain(1.35)}};
  const Analysis analysis = analyzeTrials(simulatedTrials(paces, predict::Criterion::MinHandJerk, 0, 5, 1, 15, 1), quickOptions());
  EXPECT_EQ(followed(analysis.overall, analysis.common), "min-hand-jerk") << describeConclusion(analysis.overall, analysis.common);
  EXPECT_TRUE(analysis.overall.overSubjects);
  EXPECT_EQ(analysis.overall.subjects, 5u);
}

TEST(Study, PlannedByForceChangeWithAHandMassIsDecidedForThatAndFindsTheMass) {
  const Analysis analysis = analyzeTrials(
      simulatedTrials({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandForceChange, 1.0, 5, 1, 25, 2), quickOptions());
  EXPECT_EQ(followed(analysis.overall, analysis.common), "min-hand-force-change") << describeConclusion(analysis.overall, analysis.common);
  for (const FitRow& row : fitRows(analysis)) {
    if (row.criterion == "min-hand-force-change") {
      EXPECT_NEAR(row.handMass.value(), 1.0, 0.1) << row.person->subject;
    }
  }
}

// People whose hands ignore the object, and of whom it is not asked whether they succeeded.
TEST(Study, OfHandsThatIgnoreTheObjectIsNeverConcludedUpon) {
  const auto blind = [](const experiment::Experiment& e) {
    return std::make_unique<ObjectBlindPlan>(e.task->duration, e.object.masses.size());
  };
  for (const auto& e :
       {chainExperiment(1.35), parallelExperiment(2.5), lineExperiment(experiment::ObjectKind::Chain, {3}, {}, 120, 1.35)}) {
    const Analysis analysis =
        analyzeTrials(simulatedTrials({{"blind", experiment::CompiledExperiment(e)}}, blind, 5, 1, 15, 11), quickOptions());
    EXPECT_EQ(followed(analysis.overall, analysis.common), "undecided: reference") << describeConclusion(analysis.overall, analysis.common);
    EXPECT_TRUE(analysis.overall.referenceFirst);
    for (const PersonResult& person : analysis.people) EXPECT_FALSE(person.conclusion.decided()) << person.subject;
  }
}

TEST(Study, OfTooFewTrialsConcludesNothing) {
  const Analysis analysis =
      analyzeTrials(simulatedTrials({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 5, 1, 10, 3), quickOptions());
  EXPECT_EQ(followed(analysis.overall, analysis.common), "undecided: too_few_trials");  // 8 successes each
}

TEST(Study, CountsSuccessByDayAndLeavesPracticeOut) {
  AnalysisInput input = simulatedTrials({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 2, 2, 10, 4);
  for (TrialData& trial : input.trials)
    if (trial.key.trial == 1) trial.practice = true;
  input.trials[3].result = {};
  input.trials[3].result.outcome = trial::Outcome::Aborted;
  input.trials[3].result.reason = trial::Reason::NoOnset;
  const AnalysisInput copy = input;
  const Analysis analysis = analyzeTrials(std::move(input), quickOptions());
  ASSERT_EQ(analysis.success.size(), 4u);
  EXPECT_EQ(analysis.success[0].subject, "S1");
  EXPECT_EQ(analysis.success[0].day, 1);
  EXPECT_EQ(analysis.success[0].trials, 8u);     // ten less one practice and one aborted
  EXPECT_EQ(analysis.success[0].successes, 6u);  // trials 5 and 10 failed
  EXPECT_EQ(analysis.results[0].counts.practice, 4u);
  EXPECT_EQ(analysis.results[0].counts.aborted, 1u);
  EXPECT_EQ(analysis.results[0].exclusions.at("practice"), 4u);

  AnalysisOptions with = quickOptions();
  with.includePractice = true;
  EXPECT_EQ(analyzeTrials(copy, with).success[0].trials, 9u);
}

TEST(Study, BearsOneTrialNoSuccessAndNoTrial) {
  const std::vector<Condition> conditions{{"m", compiledChain(1.35)}};
  AnalysisInput one = simulatedTrials(conditions, predict::Criterion::MinHandJerk, 0, 1, 1, 1, 7);
  AnalysisInput failed = one;
  failed.trials[0].result.outcome = trial::Outcome::Failure;
  AnalysisInput empty;
  empty.conditions = conditions;
  AnalysisInput still = one;
  for (Vec3& p : still.trials[0].hand) p = {};

  EXPECT_EQ(analyzeTrials(one, quickOptions()).results[0].used, 1u);
  const std::string caption = paperFigure(analyzeTrials(one, quickOptions()), 0).caption;
  EXPECT_NE(caption.find("Thin: 1 trial, "), std::string::npos) << caption;
  EXPECT_NE(paperFigure(analyzeTrials(empty, quickOptions()), 0).caption.find("predictions only"), std::string::npos);
  EXPECT_FALSE(analyzeTrials(one, quickOptions()).overall.decided());
  for (AnalysisInput* input : {&empty, &still}) {
    const Analysis analysis = analyzeTrials(*input, quickOptions());
    EXPECT_EQ(analysis.results[0].used, 0u);
    EXPECT_FALSE(analysis.overall.best);
    EXPECT_FALSE(analysis.results[0].signals.empty());
  }
  // Failures alone are described, but decide nothing over all.
  const Analysis analysis = analyzeTrials(failed, quickOptions());
  EXPECT_TRUE(analysis.results[0].onlyFailures);
  EXPECT_EQ(analysis.results[0].used, 1u);
  EXPECT_FALSE(analysis.overall.best);
}

// Who did only another condition takes none away from those who did the rest.
TEST(Study, JudgesTogetherTheConditionsOfTheMostSubjects) {
  const AnalysisInput two = simulatedTrials({{"slow", compiledChain(2)}, {"moderate", compiledChain(1.35)}, {"apart", compiledChain(1)}},
                                            predict::Criterion::MinHandJerk, 0, 2, 1, 15, 8);
  AnalysisInput input;
  input.conditions = two.conditions;
  for (std::size_t i = 0; i < two.trials.size(); ++i) {
    TrialData trial = two.trials[i];
    if (two.conditionOf[i] == 2 && trial.key.subject == "S2") continue;
    if (two.conditionOf[i] == 2) trial.key.subject = "S3";
    input.trials.push_back(std::move(trial));
    input.conditionOf.push_back(two.conditionOf[i]);
  }
  EXPECT_EQ(analyzeTrials(input, quickOptions()).together, (std::vector<std::size_t>{0, 1}));
}

TEST(Study, CountsInvalidTimingApartAndLeavesItOut) {
  AnalysisInput input = simulatedTrials({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 1, 6, 4);
  input.trials[0].result.reason = trial::Reason::Timing;
  input.trials[0].result.outcome = trial::Outcome::Interrupted;
  input.trials[1].goTime = 1.0;  // the hand leaves at 0.4 s
  const Analysis analysis = analyzeTrials(std::move(input), quickOptions());
  EXPECT_EQ(analysis.results[0].counts.invalidTiming, 1u);
  EXPECT_EQ(analysis.results[0].counts.beforeGo, 1u);
  EXPECT_EQ(analysis.trials[0].exclusion, "invalid timing");
  EXPECT_TRUE(std::isnan(analysis.trials[1].measures.reactionTime));
  const std::string words = describeCounts(analysis.results[0]);
  EXPECT_NE(words.find("invalid timing"), std::string::npos) << words;
  EXPECT_NE(words.find("before the go signal"), std::string::npos) << words;
}

// (1) for the duration that was moved lasts, measured like the trials, as long as they did.
TEST(Study, PredictsForTheDurationThatWasMoved) {
  AnalysisOptions options = quickOptions();
  const AnalysisInput input = simulatedTrials({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 1, 12, 3);
  const Analysis analysis = analyzeTrials(input, options);
  const ConditionResult& r = analysis.results.at(0);
  ASSERT_TRUE(r.moved);
  EXPECT_EQ(r.moved->criterion, predict::Criterion::MinHandJerk);
  EXPECT_NEAR(durationUntil(*r.moved, r.endLevel), r.duration.mean, 1e-5);
  options.predictFor = PredictionDuration::Moved;
  EXPECT_FALSE(analyzeTrials(input, options).results[0].moved) << "the prediction itself is for it";
  options = quickOptions();
  options.drawn = {predict::Criterion::MinHandForce};
  EXPECT_FALSE(analyzeTrials(input, options).results[0].moved) << "(1) is not drawn";
}

// The residuals of a trial are those that its fitted epsilon and its R^2 are made of.
TEST(Study, WritesResidualsThatGiveEpsilonAndR2OfEachTrial) {
  AnalysisOptions options = quickOptions();
  options.residuals = true;
  const Analysis analysis =
      analyzeTrials(simulatedTrials({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandForceChange, 1, 1, 1, 12, 3), options);
  std::map<std::string, std::string> files = tablesOf(analysis);
  struct Sums {
    double samples = 0, squares = 0, weighted = 0, whole = 0;
  };
  std::map<std::pair<std::string, std::string>, Sums> sums;  // of trial and column
  for (const auto& row : rowsOf(files["residuals.csv"]))
    for (const auto& [column, cell] : row) {
      if (!column.starts_with("residual_")) continue;
      const double r = std::stod(cell), w = std::stod(row.at("weight")), v = std::stod(row.at("velocity_m_per_s"));
      Sums& s = sums[{row.at("trial"), column}];
      s.samples += 1, s.squares += r * r, s.weighted += w * r * r, s.whole += w * v * v;
    }
  const auto fits = rowsOf(files["fit_trials.csv"]);
  EXPECT_EQ(sums.size(), fits.size());
  for (const auto& fit : fits) {
    std::string column = "residual_" + fit.at("criterion") + "_m_per_s";
    std::replace(column.begin(), column.end(), '-', '_');
    const Sums& s = sums.at({fit.at("trial"), column});
    const double epsilon = std::stod(fit.at("epsilon_fit_m_per_s")), unexplained = 1 - std::stod(fit.at("r2"));
    EXPECT_NEAR(std::sqrt(s.squares / s.samples), epsilon, 1e-9 * epsilon) << column;
    EXPECT_NEAR(s.weighted / s.whole, unexplained, 1e-4 * unexplained) << column;  // cost and residuals interpolate differently
  }
  options.residuals = false;
  files = tablesOf(analyzeTrials(simulatedTrials({{"m", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 1, 12, 3), options));
  EXPECT_FALSE(files.contains("residuals.csv")) << "it was not asked for";
}

}  // namespace
}  // namespace reachlab::analysis
