#include "gui/plot/trial_errors.h"

#include <numeric>

#include "analysis/measures/measures.h"
#include "analysis/measures/paper_error.h"
#include "base/error.h"
#include "base/ticks.h"

namespace reachlab::gui::plot {

std::vector<CriterionForecast> forecastAll(const experiment::CompiledExperiment& experiment, const std::stop_token& stop) {
  std::vector<CriterionForecast> forecasts;
  for (const predict::Criterion criterion : predict::kAllCriteria) {
    if (stop.stop_requested()) break;
    CriterionForecast forecast;
    forecast.criterion = criterion;
    try {
      forecast.prediction = predict::predict(experiment, forecast.criterion);
    } catch (const Error& e) {
      forecast.refusal = e.what();
    }
    forecasts.push_back(std::move(forecast));
  }
  return forecasts;
}

std::vector<std::optional<double>> computeHandErrors(std::span<const TracePoint> trace, const constraints::TaskPath& path,
                                                     const std::vector<CriterionForecast>& forecasts, const experiment::Task& task,
                                                     const TrialSpan& span) {
  std::vector<std::optional<double>> errors(forecasts.size());
  if (trace.size() < 8) return errors;
  analysis::TrialData trial;
  const std::uint64_t every = std::lcm(span.every, TraceSink::kEvery);
  trial.rate = kTicksPerSecond / static_cast<double>(every);
  trial.start = path.start();
  trial.target = path.target();
  for (const TracePoint& p : trace) {
    if (p.tick % every != 0 || (span.endTick > 0 && p.tick > span.endTick)) continue;
    if (trial.hand.empty() && span.endTick > 0) {
      const auto seconds = [&](std::uint64_t tick) { return secondsBetween(p.tick, tick); };
      trial.taskOnset = seconds(span.onsetTick);
      trial.taskEnd = seconds(span.endTick);
    }
    trial.hand.push_back(p.hand);
    trial.object.push_back(p.last);
    trial.objectVelocity.push_back(p.lastVelocity);
    trial.force.push_back(p.force);
    if (path.straight()) trial.along = {path.directionAt(0)};
    else if (const Vec3 direction = path.directionAt(p.firstQ); !(direction == Vec3{})) trial.along.push_back(direction);
  }
  if (trial.hand.size() < 8) return errors;
  const analysis::MeasureOptions options;
  const analysis::TrialSignals signals = analysis::computeSignals(trial, options);
  if (!signals.movement.found) return errors;
  const analysis::TrialProfile profile = analysis::makeTrialProfile(trial, signals);
  for (std::size_t i = 0; i < forecasts.size(); ++i) {
    if (!forecasts[i].prediction) continue;
    const double error = analysis::computePaperError(profile, analysis::recordPrediction(*forecasts[i].prediction, options, task)).hand;
    if (std::isfinite(error)) errors[i] = error;
  }
  return errors;
}

}  // namespace reachlab::gui::plot
