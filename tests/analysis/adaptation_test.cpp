// Learning from trial to trial: published numbers, recovery of what made a series, and what cannot be told.
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/adaptation/state_space.h"
#include "base/error.h"
#include "base/math/seeded.h"

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
