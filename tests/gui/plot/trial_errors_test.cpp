#include "gui/plot/trial_errors.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/experiment/experiment.h"

namespace reachlab::gui::plot {
namespace {

// A hand that moves just as `plan` says, sampled as the window samples.
std::vector<TracePoint> traceOf(const predict::Prediction& plan, const constraints::TaskPath& path) {
  std::vector<TracePoint> trace;
  const Vec3 along = path.directionAt(0);
  for (double t = -0.3; t < plan.duration + 0.3; t += TraceSink::kEvery * kTickSeconds) {
    TracePoint p;
    const predict::PredictedHand hand = plan.handAt(std::clamp(t, 0.0, plan.duration));
    const double velocity = t < 0 || t > plan.duration ? 0 : hand.velocity;
    p.hand = path.start() + hand.position * along;
    p.handVelocity = velocity * along;
    trace.push_back(p);
  }
  return trace;
}

TEST(HandErrors, AreLeastForTheCriterionThatTheHandFollowsAndNotMadeUpWithoutAMovement) {
  const experiment::CompiledExperiment compiled = experiment::openExperiment("chain-slow");
  const experiment::Experiment& experiment = compiled.experiment();
  const constraints::TaskPath path(compiled.constraint(), experiment.task->start, experiment.task->target);
  const auto forecasts = forecastAll(compiled);
  ASSERT_EQ(forecasts.size(), static_cast<std::size_t>(predict::kCriterionCount));
  const auto errors = computeHandErrors(traceOf(*forecasts[0].prediction, path), path, forecasts, *experiment.task);
  ASSERT_TRUE(errors[0].has_value());
  // What is left is the 10 Hz filter and the 5 ms grid on a profile of 1 Hz: a few thousandths of the peak.
  EXPECT_LT(*errors[0], 0.02 * forecasts[0].prediction->handPeak);
  for (std::size_t i = 1; i < errors.size(); ++i) {
    if (!errors[i]) continue;
    EXPECT_GT(*errors[i], *errors[0]) << predict::nameOf(forecasts[i].criterion);
  }
  const std::vector<TracePoint> still(200);
  for (const auto& error : computeHandErrors(still, path, forecasts, *experiment.task)) EXPECT_FALSE(error.has_value());
}

}  // namespace
}  // namespace reachlab::gui::plot
