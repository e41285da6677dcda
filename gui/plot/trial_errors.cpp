#include "gui/plot/trial_errors.h"

#include <numeric>

#include "base/error.h"
#include "sim/analyze/measures.h"
#include "sim/analyze/paper_error.h"

namespace reachlab::gui::plot {
namespace {

Vec3 unitOrZero(const Vec3& v) {
  const double length = norm(v);
  return length > 0 && std::isfinite(length) ? v / length : Vec3{};
}

Vec3 placeOf(const constraints::Constraint& constraint, const std::vector<double>& q) {
  if (constraint.kind == constraints::ConstraintKind::Curve && q.size() == 1) return constraints::evaluate(constraint.curve, q[0]).r;
  if (constraint.kind == constraints::ConstraintKind::Surface && q.size() == 2)
    return constraints::evaluate(constraint.surface, q[0], q[1]).r;
  return q.size() == 3 ? Vec3{q[0], q[1], q[2]} : Vec3{};
}

}  // namespace

std::vector<CriterionForecast> forecastAll(const experiment::Experiment& experiment, const std::stop_token& stop) {
  std::vector<CriterionForecast> forecasts;
  for (int i = 0; i < predict::kCriterionCount && !stop.stop_requested(); ++i) {
    CriterionForecast forecast;
    forecast.criterion = static_cast<predict::Criterion>(i);
    try {
      forecast.prediction = predict::predict(experiment, forecast.criterion);
    } catch (const Error& e) {
      forecast.refusal = e.what();
    }
    forecasts.push_back(std::move(forecast));
  }
  return forecasts;
}

PathDirection::PathDirection(const experiment::Experiment& experiment, const constraints::Constraint& constraint)
    : constraint_(constraint) {
  if (!experiment.task) return;
  const experiment::Task& task = *experiment.task;
  start_ = placeOf(constraint, task.start);
  target_ = placeOf(constraint, task.target);
  chord_ = unitOrZero(target_ - start_);
  straight_ = constraint.straight || constraint.kind == constraints::ConstraintKind::Free;
  if (constraint.kind == constraints::ConstraintKind::Curve && task.target[0] < task.start[0]) sign_ = -1;
}

Vec3 PathDirection::at(double q) const {
  if (straight_) return chord_;
  if (constraint_.kind == constraints::ConstraintKind::Curve) return sign_ * unitOrZero(constraints::evaluate(constraint_.curve, q).rPhi);
  return {};
}

double PathDirection::along(const Vec3& velocity, double q) const {
  const Vec3 direction = at(q);
  return direction == Vec3{} ? norm(velocity) : dot(velocity, direction);
}

std::vector<std::optional<double>> computeHandErrors(std::span<const TracePoint> trace, const PathDirection& path,
                                                     const std::vector<CriterionForecast>& forecasts, const experiment::Task& task,
                                                     const TrialSpan& span) {
  std::vector<std::optional<double>> errors(forecasts.size());
  if (trace.size() < 8) return errors;
  analyze::TrialData trial;
  const std::uint64_t every = std::lcm(span.every, TraceSink::kEvery);
  trial.rate = 1000.0 / static_cast<double>(every);
  trial.start = path.start();
  trial.target = path.target();
  for (const TracePoint& p : trace) {
    if (p.tick % every != 0 || (span.endTick > 0 && p.tick > span.endTick)) continue;
    if (trial.hand.empty() && span.endTick > 0) {
      const auto seconds = [&](std::uint64_t tick) { return (static_cast<double>(tick) - static_cast<double>(p.tick)) / 1000.0; };
      trial.taskOnset = seconds(span.onsetTick);
      trial.taskEnd = seconds(span.endTick);
    }
    trial.hand.push_back(p.hand);
    trial.object.push_back(p.last);
    trial.objectVelocity.push_back(p.lastVelocity);
    trial.force.push_back(p.force);
    if (path.straight()) trial.along = {path.at(0)};
    else if (const Vec3 direction = path.at(p.firstQ); !(direction == Vec3{})) trial.along.push_back(direction);
  }
  if (trial.hand.size() < 8) return errors;
  const analyze::MeasureOptions options;
  const analyze::TrialSignals signals = analyze::computeSignals(trial, options);
  if (!signals.movement.found) return errors;
  const analyze::TrialProfile profile = analyze::makeTrialProfile(trial, signals);
  for (std::size_t i = 0; i < forecasts.size(); ++i) {
    if (!forecasts[i].prediction) continue;
    const double error = analyze::computePaperError(profile, analyze::recordPrediction(*forecasts[i].prediction, options, task)).hand;
    if (std::isfinite(error)) errors[i] = error;
  }
  return errors;
}

}  // namespace reachlab::gui::plot
