#include "sim/predict/predict.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "constraints/error.h"
#include "sim/predict/condition.h"
#include "sim/predict/crackle_prediction.h"
#include "sim/predict/line_object.h"
#include "sim/predict/parity_prediction.h"
#include "sim/predict/peaks.h"
#include "sim/predict/series_prediction.h"

namespace reachlab {
namespace {

// Displacement along a straight task, in the direction of the target [m].
double computeStraightDistance(const Experiment& experiment, const Task& task) {
  const auto& shape = experiment.constraint.shape;
  const auto length = shape.find("length_m");
  return (length == shape.end() ? 0.2 : length->second) * std::abs(task.target.at(0) - task.start.at(0)) / (2 * std::numbers::pi);
}

std::unique_ptr<Prediction> makeLinearPrediction(const LineObject& object, Criterion criterion, double distance, double duration) {
  if (criterion == Criterion::MinCrackle) return makeCracklePrediction(object, distance, duration);
  const bool byHand = criterion == Criterion::MinHandJerk || criterion == Criterion::MinHandCrackle;
  const bool handDampingMatters = !byHand && !(criterion == Criterion::MinComAcceleration && object.handMass == 0);
  if (object.damped(handDampingMatters)) return makeSeriesPrediction(object, criterion, distance, duration);
  std::unique_ptr<Prediction> prediction = makeParityPrediction(object, criterion, distance, duration);
  if (!(prediction->condition > kClosedFormCondition && prediction->condition <= kRefuseCondition)) return prediction;
  const double condition = prediction->condition;
  prediction = makeSeriesPrediction(object, criterion, distance, duration);
  prediction->condition = condition;
  return prediction;
}

void judge(Prediction& prediction, const LineObject& object) {
  if (!object.parallel) prediction.travelTime = computeTravelTime(object);
  if (!std::isfinite(prediction.cost) || prediction.condition > kRefuseCondition || std::isnan(prediction.condition))
    throw RefusedError(fmt::format(
        "the object cannot be brought to rest in {:.6g} s with any precision (condition {:.1e} > {:.0e}{}); allow more time",
        prediction.duration, prediction.condition, kRefuseCondition,
        prediction.travelTime ? fmt::format(", a wave needs {:.4g} s through the chain and back", *prediction.travelTime) : ""));
  if (prediction.travelTime && prediction.duration < *prediction.travelTime)
    prediction.warnings.push_back(fmt::format("the movement of {:.6g} s is shorter than a wave's way through the chain and back, {:.6g} s: "
                                              "forces and speeds explode",
                                              prediction.duration, *prediction.travelTime));
  if (prediction.condition > kWarnCondition)
    prediction.warnings.push_back(fmt::format("ill-conditioned ({:.1e}): tiny changes of the object change the prediction", prediction.condition));
}

}  // namespace

std::unique_ptr<Prediction> predict(const Experiment& experiment, Criterion criterion, const PredictOptions& options) {
  if (!experiment.task) throw UsageError("task: missing; a prediction needs a start and a target");
  const Task& task = *experiment.task;
  const double duration = options.duration > 0 ? options.duration : task.duration;
  const double distance = computeStraightDistance(experiment, task);
  if (!(distance > 0)) throw UsageError("task: start and target are the same place");

  if (experiment.constraint.name != "line" || !experiment.constraint.curve.empty() || !experiment.constraint.surface.empty())
    throw RefusedError("constraint: this criterion is defined on the line");
  if (criterion == Criterion::MinTorqueChange)
    throw RefusedError(fmt::format("{}: not defined for this object", nameOf(criterion)));

  std::vector<std::string> warnings;
  const LineObject object = mergeEqualFrequencies(
      makeLineObject(experiment, options.handMass.value_or(experiment.handMass), options.handDamping), duration, warnings);
  std::unique_ptr<Prediction> prediction = makeLinearPrediction(object, criterion, distance, duration);
  prediction->criterion = criterion;
  prediction->duration = duration;
  prediction->distance = distance;
  prediction->warnings.insert(prediction->warnings.begin(), warnings.begin(), warnings.end());
  judge(*prediction, object);
  findPeaks(*prediction);
  return prediction;
}

}  // namespace reachlab
