// Learning from trial to trial: published numbers, recovery of what made a series, and what cannot be told.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/adaptation/state_space.h"
#include "analysis/sheet.h"
#include "base/error.h"
#include "base/math/seeded.h"
#include "tests/analysis/written_tables.h"

namespace reachlab::analysis {
namespace {

// Smith, Ghazizadeh & Shadmehr 2006: the fast and the slow state of their force-field experiment.
const std::vector<LearningState> kSmith{{0.59, 0.21}, {0.992, 0.02}};

// Their protocol: 300 trials in the field, 20 in the opposite one, 100 in a channel.
AdaptationSeries savings(const std::vector<LearningState>& states, double noise = 0, std::uint64_t seed = 0) {
  AdaptationSeries series;
  for (int n = 0; n < 420; ++n) series.push_back({n < 300 ? std::optional(1.0) : n < 320 ? std::optional(-1.0) : std::nullopt, {}});
  const std::vector<double> x = simulateLearning(states, series);
  for (std::size_t n = 0; n < series.size(); ++n) {
    double normal = -6;  // the sum of twelve equal draws has variance 1
    for (std::uint64_t k = 0; k < 12; ++k) normal += seededFraction(seed, 12 * n + k);
    series[n].response = x[n] + noise * normal;
  }
  return series;
}

// Values recomputed from the paper's equations with its parameters, in another program; all printed digits.
TEST(Adaptation, ReboundsAsTheTwoStateModelWasPublished) {
  const AdaptationSeries series = savings(kSmith);
  EXPECT_NEAR(*series[299].response, 0.750060669, 5e-10);
  EXPECT_NEAR(*series[319].response, -0.220273289, 5e-10);
  const auto rebound =
      std::max_element(series.begin() + 320, series.end(), [](const auto& a, const auto& b) { return *a.response < *b.response; });
  EXPECT_NEAR(*rebound->response, 0.160897459, 5e-10);
  EXPECT_EQ(rebound - (series.begin() + 320), 10);  // the eleventh channel trial
}

// Sixty trials rotated by 30 degrees and forty with the cursor clamped to the straight line, in which nothing is left to learn from.
TEST(Adaptation, TakesAClampedCursorAsATrialWithoutAnError) {
  AdaptationSeries series;
  for (int n = 0; n < 100; ++n) series.push_back({n < 60 ? std::optional(30.0) : std::nullopt, {}});
  const std::vector<double> x = simulateLearning(kSmith, series);
  Analysis analysis;
  for (int n = 0; n < 100; ++n) {
    AnalyzedTrial trial;
    trial.key = {
        .subject = "01", .session = n < 60 ? "1" : "2", .condition = "", .day = n < 60 ? 1 : 2, .run = 1, .block = 1, .trial = n + 1};
    trial.measures.maxPerpendicular = 0.01;
    trial.measures.handAngle = -x[static_cast<std::size_t>(n)];
    if (n < 60) trial.scene.rotation = 30;
    else trial.scene.clamp = 0;
    analysis.trials.push_back(trial);
  }
  const auto written = [&] {
    std::string text;
    writeAdaptationTable(analysis, [&](const std::string& name, std::string_view piece) {
      if (name == "adaptation.csv") text += piece;
    });
    return rowsOf(text);
  };
  std::vector<Row> rows = written();
  ASSERT_EQ(rows.size(), 3u) << "a row for the block of each session, and one for all";
  EXPECT_EQ(rows[0].at("trials"), "60");
  EXPECT_EQ(rows[1].at("session"), "2");
  EXPECT_NEAR(std::stod(rows[2].at("a_s")), kSmith[1].retention, 1e-4);
  EXPECT_NEAR(std::stod(rows[2].at("b_f")), kSmith[0].learningRate, 1e-4);
  const std::string plateau = rows[2].at("plateau_percent");

  analysis.trials[50].exclusion = "excluded: sneezed";
  analysis.trials[50].measures.handAngle = 80;
  rows = written();
  EXPECT_NEAR(std::stod(rows[2].at("a_s")), kSmith[1].retention, 1e-4) << "a trial that a person excluded has no say";
  EXPECT_NEAR(std::stod(rows[2].at("plateau_percent")), std::stod(plateau), 1);

  analysis.trials[99].scene.clamp = 15;
  EXPECT_EQ(written()[2].at("a_s"), "") << "a clamped error that is not 0 is not in the model";
}

// The fit's own derivatives would lead elsewhere if one of them were wrong.
TEST(Adaptation, NoParameterLeavesLessWhenItIsMoved) {
  const AdaptationSeries series = savings(kSmith, 0.1, 5);
  const auto left = [&](const std::vector<LearningState>& states) {
    const std::vector<double> x = simulateLearning(states, series);
    double sum = 0;
    for (std::size_t n = 0; n < series.size(); ++n) sum += (x[n] - *series[n].response) * (x[n] - *series[n].response);
    return sum;
  };
  const AdaptationFit fit = fitAdaptation(series, 100, 1);
  for (const std::vector<LearningState>& states : {fit.one.states, fit.two.states})
    for (std::size_t k = 0; k < states.size(); ++k)
      for (double LearningState::*parameter : {&LearningState::retention, &LearningState::learningRate})
        for (const double way : {-1e-4, 1e-4}) {
          std::vector<LearningState> moved = states;
          moved[k].*parameter += way;
          EXPECT_GT(left(moved), left(states)) << states.size() << " states, state " << k << " moved by " << way;
        }
}

TEST(Adaptation, SaysThatOneStateIsEnoughWhereOneMadeTheSeries) {
  EXPECT_EQ(fitAdaptation(savings({{0.97, 0.1}}, 0.05, 3), 100, 1).count, StateCount::One);
}

TEST(Adaptation, LeavesOutTrialsWhoseResponseIsNotKnown) {
  AdaptationSeries series = savings(kSmith);
  for (std::size_t n = 0; n < series.size(); n += 3) series[n].response.reset();
  const AdaptationFit fit = fitAdaptation(series, 100, 1);
  EXPECT_EQ(fit.responses, 280u);
  EXPECT_NEAR(fit.two.states[1].retention, kSmith[1].retention, 1e-6);
}

TEST(Adaptation, RefusesASeriesThatTeachesNothing) {
  AdaptationSeries still(50, AdaptationTrial{0.0, 0.1});
  EXPECT_THROW(fitAdaptation(still, 100, 1), RefusedError);
  EXPECT_THROW(fitAdaptation(AdaptationSeries(11, AdaptationTrial{1.0, 0.1}), 100, 1), RefusedError);
  AdaptationSeries before(40, AdaptationTrial{0.0, 0.1});
  before.resize(80, AdaptationTrial{1.0, {}});
  EXPECT_THROW(fitAdaptation(before, 100, 1), RefusedError) << "no response follows a perturbation";
}

// Squares of larger numbers are infinite and of smaller ones zero: nothing could be fitted to them.
TEST(Adaptation, DoesNotDependOnTheUnitAndRefusesNumbersWhoseSquaresAreNoNumbers) {
  const auto inUnit = [](double unit) {
    AdaptationSeries series = savings(kSmith, 0.05, 3);
    for (AdaptationTrial& trial : series) {
      if (trial.perturbation) *trial.perturbation *= unit;
      *trial.response *= unit;
    }
    return series;
  };
  const AdaptationFit fit = fitAdaptation(inUnit(1), 100, 1);
  for (const double unit : {1e-90, 1e90})
    EXPECT_NEAR(fitAdaptation(inUnit(unit), 100, 1).one.states[0].retention, fit.one.states[0].retention, 1e-6);
  for (const double unit : {5e-324, 1e-200, 1e160, 1e300}) EXPECT_THROW(fitAdaptation(inUnit(unit), 100, 1), RefusedError) << unit;
}

TEST(Adaptation, RefusesMoreTrialsThanAFitCanTakeInMinutes) {
  EXPECT_THROW(fitAdaptation(AdaptationSeries(10'001, AdaptationTrial{1.0, 0.1}), 100, 1), RefusedError);
}

}  // namespace
}  // namespace reachlab::analysis
