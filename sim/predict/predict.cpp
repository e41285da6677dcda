#include "sim/predict/predict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/fault.h"
#include "base/number_range.h"
#include "constraints/geometry/task_path.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/tested_ranges.h"
#include "sim/predict/arm/arm_prediction.h"
#include "sim/predict/curve/path_predictions.h"
#include "sim/predict/line/line_predictions.h"
#include "sim/predict/line/line_object.h"
#include "sim/predict/peaks.h"
#include "sim/predict/prediction/condition.h"

namespace reachlab::predict {
namespace {

// Where the task goes when it goes straight: along a line of the catalogue, any curve with constant r_phi, or freely in space.
struct StraightTask {
  Vec3 start, target;  // [m] world
  double distance = 0;
};

// Nothing on any other curve and on surfaces. That r_phi is constant is known of the formula as a whole, not of points.
std::optional<StraightTask> findStraightTask(const constraints::Constraint& constraint, const experiment::Task& task) {
  StraightTask straight;
  if (constraint.kind == constraints::ConstraintKind::Free) {
    const auto place = [](const std::vector<double>& q) { return Vec3{q.at(0), q.at(1), q.at(2)}; };
    straight.start = place(task.start);
    straight.target = place(task.target);
    straight.distance = norm(straight.target - straight.start);
    return straight;
  }
  if (constraint.kind != constraints::ConstraintKind::Curve || !constraint.straight) return std::nullopt;
  const double from = task.start.at(0), way = task.target.at(0) - from;
  straight.start = evaluate(constraint.curve, from).r;
  straight.target = evaluate(constraint.curve, task.target[0]).r;
  straight.distance = norm(evaluate(constraint.curve, from + way / 2).rPhi) * std::abs(way);
  return straight;
}

// The arm moves in the plane of x, along, and -z, away from the chest.
std::unique_ptr<Prediction> makeArmPrediction(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                              const StraightTask& straight, const LineObject& object, double duration,
                                              const PredictOptions& options) {
  const ArmTask task{{straight.start.x, -straight.start.z}, {straight.target.x, -straight.target.z}, duration};
  constexpr double kInPlane = 1e-9;  // of the way
  if (constraint.kind == constraints::ConstraintKind::Free) {
    if (std::abs(straight.target.y - straight.start.y) > kInPlane * straight.distance)
      throw RefusedError("min-torque-change: the arm moves in the plane of x and z, and the way from start to target leaves it");
    return makeFreeArmPrediction(experiment.arm, task, static_cast<int>(object.source.size()), options.unknowns);
  }
  const Vec3 way = straight.target - straight.start;
  if (std::hypot(way.y, way.z) > kInPlane * norm(way))
    throw RefusedError("min-torque-change: the line must lie along x, as the arm's task plane does");
  return makeLineArmPrediction(experiment.arm, task, object, options.unknowns, options.near);
}

bool weighsForce(Criterion criterion) { return criterion == Criterion::MinHandForce || criterion == Criterion::MinHandForceChange; }

// A point that is the hand itself, along a line.
std::unique_ptr<Prediction> makeStraightHandPrediction(const LineObject& object, Criterion criterion, double distance, double duration) {
  if (criterion == Criterion::MinTorqueChange)
    throw RefusedError("min-torque-change: on a line it is computed for a point behind its spring; allowed: a point behind its spring");
  if (weighsForce(criterion) && (object.handDamping > 0 || (!object.viscosity.empty() && object.viscosity[0] > 0)))
    throw RefusedError(
        fmt::format("{}: a point that is the hand itself is computed without damping; allowed: no viscosity and no damping of "
                    "the hand, or a point behind its spring",
                    nameOf(criterion)));
  return makeRigidPrediction(object.totalMass(), criterion, distance, duration);
}

std::unique_ptr<Prediction> makeLinearPrediction(const LineObject& object, Criterion criterion, double distance, double duration) {
  if (criterion == Criterion::MinCrackle) return makeCracklePrediction(object, distance, duration);
  const bool byHand = criterion == Criterion::MinHandJerk || criterion == Criterion::MinHandCrackle;
  const bool handDampingMatters = !byHand && !(criterion == Criterion::MinComAcceleration && object.handMass == 0);
  if (object.damped(handDampingMatters)) return makeMinimumEnergyPrediction(object, criterion, distance, duration);
  std::unique_ptr<Prediction> prediction = makeSymmetricPrediction(object, criterion, distance, duration);
  if (!(prediction->condition > kClosedFormCondition && prediction->condition <= kRefuseCondition)) return prediction;
  const double condition = prediction->condition;
  prediction = makeMinimumEnergyPrediction(object, criterion, distance, duration);
  prediction->condition = condition;
  return prediction;
}

// Several hands on one object: each criterion but jerk weighs one hand's force or place against the object's, and says nothing of how
// several share it. Jerk is taken as that of hands and object alike, moved as one.
std::unique_ptr<Prediction> makeTogetherPrediction(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                                   const std::optional<StraightTask>& straight, Criterion criterion, double duration,
                                                   int unknowns) {
  if (criterion != Criterion::MinHandJerk)
    throw RefusedError(fmt::format("{}: defined for one hand, and {} hold the object; min-hand-jerk is computed for them moving as one",
                                   nameOf(criterion), experiment.hands.size()));
  const experiment::Task& task = *experiment.task;
  if (!straight) return makeCurveJerkPrediction(constraint, task.start.at(0), task.target.at(0), duration, unknowns);
  double mass = 0;
  for (const double m : experiment.object.masses) mass += m;
  auto prediction = makeRigidPrediction(mass, criterion, straight->distance, duration);
  prediction->distance = straight->distance;
  return prediction;
}

void judge(Prediction& prediction, const LineObject* object) {
  if (object != nullptr && !object->parallel) prediction.travelTime = computeTravelTime(*object);
  if (!std::isfinite(prediction.cost) && prediction.condition <= kRefuseCondition)
    throw RefusedError(
        fmt::format("the cost in {:.6g} s is beyond the largest number; allow more time, or take fewer masses", prediction.duration));
  if (prediction.condition > kRefuseCondition || std::isnan(prediction.condition))
    throw RefusedError(fmt::format(
        "the object cannot be brought to rest in {:.6g} s with any precision (condition {:.1e} > {:.0e}{}); allow more time",
        prediction.duration, prediction.condition, kRefuseCondition,
        prediction.travelTime ? fmt::format(", a wave needs {:.4g} s through the chain and back", *prediction.travelTime) : ""));
  if (prediction.travelTime && prediction.duration < *prediction.travelTime)
    prediction.warnings.push_back(
        fmt::format("the movement of {:.6g} s is shorter than a wave's way through the chain and back, {:.6g} s: "
                    "forces and speeds explode",
                    prediction.duration, *prediction.travelTime));
  if (prediction.condition > kWarnCondition)
    prediction.warnings.push_back(
        fmt::format("ill-conditioned ({:.1e}): tiny changes of the object change the prediction", prediction.condition));
}

// Gravity that pulls along the way would let the masses hang at other places than start and target.
void requireNoGravityAlong(const constraints::ArcCurve& curve, const Vec3& gravity) {
  constexpr int kProbes = 64;
  for (int i = 0; i <= kProbes; ++i) {
    const double along = dot(curve.expand<2>(curve.length() * i / kProbes)[1], gravity);
    if (std::abs(along) > 1e-9)
      throw RefusedError(
          fmt::format("min-hand-jerk: gravity has {:.3g} m/s^2 along the curve, so that the masses rest neither at the start nor at "
                      "the target; allowed: gravity across the curve, or none",
                      along));
  }
}

// The hand alone, or with its object, on a curve or a surface.
std::unique_ptr<Prediction> makeBentPrediction(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                               Criterion criterion, double duration, const std::optional<LineObject>& object,
                                               int unknowns) {
  if (criterion != Criterion::MinHandJerk)
    throw RefusedError(
        fmt::format("{}: defined on a straight line; min-hand-jerk is the criterion for other curves and surfaces", nameOf(criterion)));
  const experiment::Task& task = *experiment.task;
  if (constraint.kind == constraints::ConstraintKind::Curve) {
    if (!object) return makeCurveJerkPrediction(constraint, task.start.at(0), task.target.at(0), duration, unknowns);
    const constraints::ArcCurve curve(constraint, task.start.at(0), task.target.at(0));
    requireNoGravityAlong(curve, experiment.object.gravity);
    return makeCurveObjectPrediction(curve, *object, duration, unknowns);
  }
  if (object)
    throw RefusedError(
        "min-hand-jerk: on surfaces it is computed for a point that is the hand itself; what hangs behind a spring needs a curve");
  return makeSurfaceJerkPrediction(constraint, task.start, task.target, duration, 1, unknowns);
}

// A bound of the fastest motion that the object has, by Gershgorin's discs [rad/s].
double fastestSwing(const experiment::Experiment& experiment, double handMass) {
  const experiment::Object& object = experiment.object;
  const double coupling = experiment.coupling ? experiment.coupling->stiffness : 0;
  const bool parallel = object.kind == experiment::ObjectKind::Parallel;
  const auto spring = [&](std::size_t i) { return i < object.stiffness.size() ? object.stiffness[i] : 0.0; };
  double most = 0, onHand = coupling;
  for (std::size_t i = 0; i < object.masses.size(); ++i) {
    const double held = parallel ? spring(i) : (i == 0 ? coupling : spring(i - 1)) + spring(i);
    if (parallel) onHand += spring(i);
    if (object.masses[i] > 0) most = std::max(most, 2 * held / object.masses[i]);  // without a mass it is refused later, by its name
  }
  if (handMass > 0) most = std::max(most, 2 * onHand / handMass);
  return std::sqrt(most);
}

// What a prediction takes grows with the swings that it resolves.
void requireFewSwings(const experiment::Experiment& experiment, double handMass, double duration) {
  constexpr double kMostSwings = 1e6;
  const double swings = fastestSwing(experiment, handMass) * duration / (2 * std::numbers::pi);
  if (swings > kMostSwings)
    throw RefusedError(
        fmt::format("the object swings some {:.2g} times in {:.6g} s; allowed: {:.0e}, by softer springs, heavier masses or less time",
                    swings, duration, kMostSwings));
}

// Whoever asks. What is nearly nothing is no part of an object, and no method was tested with it.
void requireTested(const experiment::Experiment& experiment, double duration, double handMass, double handDamping) {
  constexpr double kLeastMass = 1e-6, kLeastSpring = 1e-9;  // [kg], [N/m]
  std::vector<Fault> faults;
  checkNumber("duration", duration, experiment::durationRange(), faults);
  checkNumber("hand_damping", handDamping, experiment::dampingRange(), faults);
  checkNumber("hand_mass", handMass, experiment::handMassRange(), faults);
  if (handMass > 0 && handMass < kLeastMass) faults.push_back({"hand_mass", fmt::format("is {}", handMass), "0, or 1e-06 kg or more"});
  for (const double spring : experiment.object.stiffness)
    if (spring > 0 && spring < kLeastSpring)
      faults.push_back({"object.stiffness_n_per_m", fmt::format("has {}", spring), "0, or 1e-09 N/m or more"});
  if (!faults.empty()) throw FaultError(std::move(faults));
}

}  // namespace

Fault missingTaskFault() { return {"task", "is missing, and a prediction needs one", "{ start, target, … }"}; }

std::unique_ptr<Prediction> predict(const experiment::Experiment& experiment, Criterion criterion, const PredictOptions& options) {
  return predict(experiment, constraints::makeConstraint(experiment.constraint), criterion, options);
}

std::unique_ptr<Prediction> predict(const experiment::CompiledExperiment& experiment, Criterion criterion, const PredictOptions& options) {
  return predict(experiment.experiment(), experiment.constraint(), criterion, options);
}

std::unique_ptr<Prediction> predict(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                    Criterion criterion, const PredictOptions& options) {
  if (!experiment.task) throw FaultError(missingTaskFault());
  const experiment::Task& task = *experiment.task;
  const auto parameters = static_cast<size_t>(constraint.kind == constraints::ConstraintKind::Free ? 3 : constraint.parameterCount());
  if (task.start.size() != parameters || task.target.size() != parameters)
    throw FaultError(Fault{"task", "has start and target of another length", fmt::format("{} numbers each", parameters)});
  if (task.start == task.target) throw FaultError(constraints::samePlaceFault());
  if (!task.via.empty())
    throw FaultError(Fault{"task.via_m", "has via points, and predictions go straight to the target", "a task without via_m"});
  const double duration = options.duration > 0 ? options.duration : task.duration;
  const double handMass = options.handMass.value_or(experiment.handMass);
  requireTested(experiment, duration, handMass, options.handDamping);
  requireFewSwings(experiment, handMass, duration);

  std::unique_ptr<Prediction> prediction;
  std::vector<std::string> warnings;
  std::optional<LineObject> object;
  std::optional<PointIs> point;
  if ((weighsForce(criterion) || criterion == Criterion::MinTorqueChange) && !experiment.environment.empty())
    warnings.push_back("environment acts on the hand, and its forces are no part of the prediction");
  if (experiment.cursor && experiment.cursor->gain != 1 && experiment.cursor->judge == experiment::CursorJudge::Cursor)
    warnings.push_back(fmt::format("distances are the cursor's; the hand moves by 1/{} of them", experiment.cursor->gain));
  const bool bare = experiment.object.kind == experiment::ObjectKind::None;
  const bool isPoint = bare || experiment.object.kind == experiment::ObjectKind::Point;
  if (options.point && (!isPoint || bare))
    throw FaultError(Fault{"point", "is given, and the object is no point", "only with an object of kind point"});
  if (experiment.object.kind == experiment::ObjectKind::Body)
    throw FaultError(Fault{"object.kind", "is body", "point, chain, parallel: the criteria are not defined for a body that turns"});
  const auto makeObject = [&] {
    return mergeEqualFrequencies(makeLineObject(experiment, handMass, options.handDamping), duration, warnings);
  };
  const std::optional<StraightTask> straight = findStraightTask(constraint, task);
  if (straight && !(straight->distance > 0)) throw FaultError(constraints::samePlaceFault());
  if (experiment.hands.size() > 1) {
    if (isPoint) point = PointIs::Hand;
    prediction = makeTogetherPrediction(experiment, constraint, straight, criterion, duration, options.unknowns);
  } else if (straight) {
    const StraightTask& way = *straight;
    object = makeObject();
    if (std::abs(dot(experiment.object.gravity, way.target - way.start)) > 0)
      warnings.push_back(
          "gravity along the line shifts the rest position alone: the movement is the one between equilibria, forces without the "
          "weight");
    const bool freeArm = constraint.kind == constraints::ConstraintKind::Free && criterion == Criterion::MinTorqueChange;
    if (freeArm && (options.handMass.value_or(0) > 0 || options.handDamping > 0))
      warnings.push_back("hand mass and hand damping have no part in a free arm's torques");
    if (isPoint) point = freeArm ? PointIs::Hand : options.point.value_or(bare ? PointIs::Hand : PointIs::BehindSpring);
    if (point == PointIs::Hand && !freeArm) {
      prediction = makeStraightHandPrediction(*object, criterion, way.distance, duration);
      object.reset();
    } else {
      prediction = criterion == Criterion::MinTorqueChange ? makeArmPrediction(experiment, constraint, way, *object, duration, options)
                                                           : makeLinearPrediction(*object, criterion, way.distance, duration);
      if (freeArm) object.reset();  // the hand carries nothing
    }
    prediction->distance = way.distance;
  } else {
    if (isPoint) point = options.point.value_or(PointIs::Hand);
    if (point != PointIs::Hand) object = makeObject();
    prediction = makeBentPrediction(experiment, constraint, criterion, duration, object, options.unknowns);
  }
  prediction->criterion = criterion;
  prediction->duration = duration;
  prediction->point = point;
  prediction->warnings.insert(prediction->warnings.begin(), warnings.begin(), warnings.end());
  judge(*prediction, object ? &*object : nullptr);
  findPeaks(*prediction);
  return prediction;
}

}  // namespace reachlab::predict
