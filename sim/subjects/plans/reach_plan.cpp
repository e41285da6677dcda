#include "sim/subjects/plans/reach_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/fault.h"
#include "base/math/minimum_jerk.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "constraints/geometry/curve_way.h"
#include "constraints/geometry/task_path.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/protocol.h"

namespace reachlab::subjects {
namespace {

// A plan and the time that the protocol will measure when it is carried out to the letter, from onset to arrival.
struct TimedPlan {
  ReachPlan plan;
  double arrival = 0;  // [s]
};
using MakePlan = std::function<TimedPlan(double duration)>;

constexpr double kShortestLine = 0.01, kLongestLine = 1;  // [m] of the catalogue's line

// From the first time that `hasLeft` to the first one from there on that `isThere`.
template <typename HasLeft, typename IsThere>
double computeArrival(double duration, HasLeft&& hasLeft, IsThere&& isThere) {
  double onset = 0;
  while (onset < duration && !hasLeft(onset)) onset += kTickSeconds;
  double t = onset;
  while (t < duration && !isThere(t)) t += kTickSeconds;
  return t - onset;
}

ReachPlan timeForTask(const experiment::Task& task, const MakePlan& makePlan) {
  TimedPlan timed = makePlan(task.duration);
  if (timed.arrival >= task.duration - task.tolerance.time) return timed.plan;
  double shorter = task.duration, longer = task.duration;
  while (timed.arrival < task.duration && longer < 8 * task.duration) timed = makePlan(longer *= 1.5);
  const double accuracy = std::max(kTickSeconds, 0.05 * task.tolerance.time);
  while (std::abs(timed.arrival - task.duration) > accuracy && longer - shorter > kTickSeconds) {
    const double middle = (shorter + longer) / 2;
    timed = makePlan(middle);
    (timed.arrival < task.duration ? shorter : longer) = middle;
  }
  return timed.plan;
}

std::shared_ptr<const predict::Prediction> predictLasting(double duration, const experiment::Experiment& experiment,
                                                          const constraints::Constraint& constraint, predict::Criterion criterion,
                                                          std::optional<double> handMass) {
  predict::PredictOptions options;
  options.handMass = handMass;
  options.duration = duration;
  return predict::predict(experiment, constraint, criterion, options);
}

// Whether every mass is at the end of a way of this length and slow enough, with lengths and speeds `scale` times those of the prediction.
bool areThere(const predict::Prediction& prediction, double t, double length, double scale, const experiment::Tolerance& tolerance) {
  std::vector<double> x(static_cast<std::size_t>(prediction.massCount())), v(x.size());
  prediction.massesAt(t, x, v);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (scale * std::abs(x[i] - length) > tolerance.position || scale * std::abs(v[i]) > tolerance.velocity) return false;
  return true;
}

/// How far along a way of this length the hand is at `t`. The ends of a prediction are inner limits: a hand without mass that is weighed by its force
/// jumps there, from rest and to rest. A stretched time may miss the duration by rounding.
double placeAt(const predict::Prediction& prediction, double t, double duration, double length) {
  constexpr double kRounding = 1e-9;
  if (t <= 0) return 0;
  return t >= (1 - kRounding) * duration ? length : prediction.handAt(t).position;
}

// What the criterion predicts for a way of this length, timed; `place` lays a distance from the start into the world.
ReachPlan planByPrediction(const experiment::Experiment& experiment, double length, predict::Criterion criterion,
                           std::optional<double> handMass, std::function<Vec3(double)> place) {
  const LineExperiment line = onLine(experiment, length);
  const double scale = line.scale;
  const constraints::Constraint lineConstraint = constraints::makeConstraint(line.experiment.constraint);
  const experiment::Task& task = *line.experiment.task;
  return timeForTask(task, [&](double duration) {
    const auto prediction = predictLasting(duration, line.experiment, lineConstraint, criterion, handMass);
    const auto hasLeft = [&](double t) { return scale * std::abs(prediction->handAt(t).position) > task.onset; };
    const auto isThere = [&](double t) { return areThere(*prediction, t, line.length, scale, task.tolerance); };
    const double whole = line.length;
    return TimedPlan{{duration, [=](double t) { return place(scale * placeAt(*prediction, t, duration, whole)); }},
                     computeArrival(duration, hasLeft, isThere)};
  });
}

ReachPlan planAlongChord(const experiment::Experiment& experiment, const Vec3& start, const Vec3& target, predict::Criterion criterion,
                         std::optional<double> handMass) {
  const double length = norm(target - start);
  const Vec3 direction = (target - start) / length;
  return planByPrediction(experiment, length, criterion, handMass, [=](double s) { return start + s * direction; });
}

std::shared_ptr<const constraints::CurveWay> wayOf(const experiment::Task& task, const constraints::Constraint& constraint) {
  return std::make_shared<const constraints::CurveWay>(constraint, task.start[0], task.target[0]);
}

// The prediction for a line as long as the curve, laid along the arc.
ReachPlan planAlongCurve(const experiment::Experiment& experiment, const constraints::Constraint& constraint, predict::Criterion criterion,
                         std::optional<double> handMass) {
  const auto way = wayOf(*experiment.task, constraint);
  return planByPrediction(experiment, way->length(), criterion, handMass, [=](double s) { return way->at(s).r; });
}

// How far ahead of one mass the hand must be for the coupling to give it `forceAt`: k d + b d' = F, d = 0 before the start. With a damper that
// is F of the last moments, weighed by exp(-s k/b): three points of Gauss and Laguerre, exact for a force of the fifth degree over them. A
// lead that points inwards in a bend turns with it, and its damper pulls back along the way as strongly as the spring pulls on.
template <class ForceAt>
Vec3 leadFor(const ForceAt& forceAt, const experiment::Coupling& coupling, double t) {
  if (coupling.damping == 0) return forceAt(t) / coupling.stiffness;
  constexpr double kPoints[] = {0.41577455678347908, 2.2942803602790417, 6.2899450829374792},
                   kWeights[] = {0.71109300992917302, 0.27851773356924085, 0.01038925650158614};
  const double seconds = coupling.damping / coupling.stiffness;
  Vec3 force;
  for (int k = 0; k < 3; ++k)
    if (const double before = t - kPoints[k] * seconds; before > 0) force += kWeights[k] * forceAt(before);
  return force / coupling.stiffness;
}

// What the criterion predicts on the curve itself. Of a point on a curve the prediction is the mass, and the hand leads it by the spring's
// extension.
ReachPlan planByCurvePrediction(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                predict::Criterion criterion, std::optional<double> handMass) {
  const auto way = wayOf(*experiment.task, constraint);
  const experiment::Task& task = *experiment.task;
  const bool point = experiment.object.kind == experiment::ObjectKind::Point;
  if (point && (!experiment.coupling || !(experiment.coupling->stiffness > 0)))
    throw RefusedError("coupling.stiffness_n_per_m: 0; nothing joins the simulated subject to the object");
  const double mass = experiment.object.masses.at(0), viscosity = experiment.object.viscosity;
  const experiment::Coupling coupling = experiment.coupling.value_or(experiment::Coupling{});
  return timeForTask(task, [&](double duration) {
    const auto prediction = predictLasting(duration, experiment, constraint, criterion, handMass);
    const auto forceAt = [=](double t) {
      const predict::PredictedHand hand = prediction->handAt(t);
      const constraints::CurvePoint at = way->at(hand.position);
      const Vec3 along = way->sense() / norm(at.rPhi) * at.rPhi;
      const Vec3 bend = (at.rPhiPhi - dot(along, at.rPhiPhi) * along) / dot(at.rPhi, at.rPhi);
      const Vec3 acceleration = hand.acceleration * along + hand.velocity * hand.velocity * bend;
      return mass * acceleration + viscosity * hand.velocity * along;
    };
    const auto handAt = [=](double t) {
      const Vec3 place = way->at(prediction->handAt(t).position).r;
      if (!point) return place;
      const Vec3 lead = leadFor(forceAt, coupling, t);
      return isFinite(lead) ? place + lead : place;
    };
    const Vec3 start = handAt(0);
    const auto hasLeft = [&](double t) { return norm(handAt(t) - start) > task.onset; };
    const auto isThere = [&](double t) { return areThere(*prediction, t, way->length(), 1, task.tolerance); };
    return TimedPlan{{duration, handAt}, computeArrival(duration, hasLeft, isThere)};
  });
}

struct Motion {
  Vec3 r, v, a;  // [m], [m/s], [m/s^2]
};

// The minimum-jerk law in the parameters of a curve or surface.
struct ParameterReach {
  constraints::Constraint constraint;
  std::array<double, 2> from{}, by{};

  Motion at(double t, double duration) const {
    const double x = t / duration, way = minimumJerk(x);
    const double rate = minimumJerkRate(x) / duration, change = minimumJerkAcceleration(x) / (duration * duration);
    const double q = from[0] + by[0] * way, u = by[0] * rate;
    if (constraint.kind == constraints::ConstraintKind::Curve) {
      const constraints::CurvePoint p = constraints::evaluate(constraint.curve, q);
      return {p.r, u * p.rPhi, by[0] * change * p.rPhi + u * u * p.rPhiPhi};
    }
    const constraints::SurfacePoint p = constraints::evaluate(constraint.surface, q, from[1] + by[1] * way);
    const double w = by[1] * rate;
    return {p.r, u * p.rU + w * p.rV, by[0] * change * p.rU + by[1] * change * p.rV + u * u * p.rUu + 2 * u * w * p.rUv + w * w * p.rVv};
  }
};

ReachPlan planByInverseDynamics(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                const trial::ProtocolSettings& place) {
  const experiment::Task& task = *experiment.task;
  const double mass = experiment.object.masses.at(0), viscosity = experiment.object.viscosity;
  const experiment::Coupling coupling = *experiment.coupling;
  ParameterReach reach{constraint};
  for (int k = 0; k < constraint.parameterCount(); ++k) {
    reach.from[k] = task.start[k];
    reach.by[k] = task.target[k] - task.start[k];
  }
  if (reach.by[0] == 0 && reach.by[1] == 0) throw FaultError(constraints::samePlaceFault());
  return timeForTask(task, [&](double duration) {
    const auto forceAt = [=](double t) {
      const Motion m = reach.at(t, duration);
      return mass * m.a + viscosity * m.v;
    };
    const auto handAt = [=](double t) {
      const Vec3 there = reach.at(t, duration).r, lead = leadFor(forceAt, coupling, t);
      return isFinite(lead) ? there + lead : there;  // at a pole the parameters say nothing of the acceleration
    };
    const auto hasLeft = [&](double t) { return norm(handAt(t) - place.start) > task.onset; };
    const auto isThere = [&](double t) {
      const Motion m = reach.at(t, duration);
      return norm(m.r - place.target) <= task.tolerance.position && norm(m.v) <= task.tolerance.velocity;
    };
    return TimedPlan{{duration, handAt}, computeArrival(duration, hasLeft, isThere)};
  });
}

}  // namespace

LineExperiment onLine(const experiment::Experiment& experiment, double length) {
  LineExperiment line{experiment, std::clamp(length, kShortestLine, kLongestLine)};
  line.scale = length / line.length;
  line.experiment.constraint = {};
  line.experiment.constraint.name = "line";
  line.experiment.constraint.shape = {{"length_m", line.length}};
  line.experiment.task->start = {0};
  line.experiment.task->target = {2 * std::numbers::pi};
  if (experiment.object.kind == experiment::ObjectKind::Body) line.experiment.object.kind = experiment::ObjectKind::Point;
  return line;
}

ReachPlan makeReachPlan(const experiment::CompiledExperiment& compiled, std::optional<predict::Criterion> criterion,
                        std::optional<double> handMass) {
  const experiment::Experiment& experiment = compiled.experiment();
  const constraints::Constraint& constraint = compiled.constraint();
  const trial::ProtocolSettings place = trial::makeProtocolSettings(experiment, constraint);
  const bool flat = constraint.kind == constraints::ConstraintKind::Free || constraint.straight;
  if (flat && place.start == place.target) throw FaultError(constraints::samePlaceFault());
  constexpr auto kUsual = predict::Criterion::MinHandJerk;
  if (flat) return planAlongChord(experiment, place.start, place.target, criterion.value_or(kUsual), handMass);
  const bool curve = constraint.kind == constraints::ConstraintKind::Curve;
  if ((criterion || handMass) && !curve)
    throw FaultError(Fault{
        "device",
        fmt::format(
            "simulated: {}: the simulated subject plans by a criterion on lines, on curves and free in space, not on the surface '{}'",
            criterion ? fmt::format("criterion={}", predict::nameOf(*criterion)) : fmt::format("hand-mass={}", *handMass),
            experiment.constraint.name),
        "neither criterion nor hand-mass here"});
  const bool flexible =
      experiment.object.kind == experiment::ObjectKind::Chain || experiment.object.kind == experiment::ObjectKind::Parallel;
  if (criterion) return planByCurvePrediction(experiment, constraint, *criterion, handMass);
  if (curve) {
    try {
      return planByCurvePrediction(experiment, constraint, kUsual, handMass);
    } catch (const RefusedError&) {  // a cusp, gravity along the way …: what was not asked for gives way
    }
  }
  if (flexible && curve) return planAlongCurve(experiment, constraint, kUsual, handMass);
  if (flexible) throw RefusedError("the simulated subject has no plan for several masses on a surface; use one mass, or a curve");
  if (!experiment.coupling || !(experiment.coupling->stiffness > 0))
    throw RefusedError("coupling.stiffness_n_per_m: 0; nothing joins the simulated subject to the object");
  return planByInverseDynamics(experiment, constraint, place);
}

}  // namespace reachlab::subjects
