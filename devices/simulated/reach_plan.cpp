#include "devices/simulated/reach_plan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/error.h"
#include "sim/trial/protocol.h"

namespace reachlab::devices {
namespace {

// A plan and the time that the protocol will measure when it is carried out to the letter, from onset to arrival.
struct TimedPlan {
  ReachPlan plan;
  double arrival = 0;  // [s]
};
using MakePlan = std::function<TimedPlan(double duration)>;

constexpr double kLook = 0.001;                           // [s]
constexpr double kShortestLine = 0.01, kLongestLine = 1;  // [m] of the catalogue's line

// From the first time that `hasLeft` to the first one from there on that `isThere`.
template <typename HasLeft, typename IsThere>
double computeArrival(double duration, HasLeft&& hasLeft, IsThere&& isThere) {
  double onset = 0;
  while (onset < duration && !hasLeft(onset)) onset += kLook;
  double t = onset;
  while (t < duration && !isThere(t)) t += kLook;
  return t - onset;
}

ReachPlan timeForTask(const experiment::Task& task, const MakePlan& makePlan) {
  TimedPlan timed = makePlan(task.duration);
  if (timed.arrival >= task.duration - task.tolerance.time) return timed.plan;
  double shorter = task.duration, longer = task.duration;
  while (timed.arrival < task.duration && longer < 8 * task.duration) timed = makePlan(longer *= 1.5);
  const double accuracy = std::max(kLook, 0.05 * task.tolerance.time);
  while (std::abs(timed.arrival - task.duration) > accuracy && longer - shorter > kLook) {
    const double middle = (shorter + longer) / 2;
    timed = makePlan(middle);
    (timed.arrival < task.duration ? shorter : longer) = middle;
  }
  return timed.plan;
}

// The same object on a straight line: what the criteria are defined for.
experiment::Experiment onLine(const experiment::Experiment& experiment, double length) {
  experiment::Experiment line = experiment;
  line.constraint = {};
  line.constraint.name = "line";
  line.constraint.shape = {{"length_m", length}};
  line.task->start = {0};
  line.task->target = {2 * std::numbers::pi};
  if (line.object.kind == experiment::ObjectKind::Body) line.object.kind = experiment::ObjectKind::Point;
  return line;
}

// What the criterion predicts for a way of this length, timed; `place` lays a distance from the start into the world.
ReachPlan planByPrediction(const experiment::Experiment& experiment, double length, predict::Criterion criterion,
                           std::optional<double> handMass, std::function<Vec3(double)> place) {
  // Ways that no line has are predicted on the nearest one: the reaches of an object on springs scale with the distance.
  const double lineLength = std::clamp(length, kShortestLine, kLongestLine), scale = length / lineLength;
  const experiment::Experiment line = onLine(experiment, lineLength);
  const experiment::Task& task = *line.task;
  return timeForTask(task, [&](double duration) {
    predict::PredictOptions options;
    options.handMass = handMass;
    options.duration = duration;
    const std::shared_ptr<const predict::Prediction> prediction = predict::predict(line, criterion, options);
    std::vector<double> x(line.object.masses.size()), v(x.size());
    const auto hasLeft = [&](double t) { return scale * std::abs(prediction->handAt(t).position) > task.onset; };
    const auto isThere = [&](double t) {
      prediction->massesAt(t, x, v);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (scale * std::abs(x[i] - lineLength) > task.tolerance.position || scale * std::abs(v[i]) > task.tolerance.velocity) return false;
      return true;
    };
    return TimedPlan{{duration, [=](double t) { return place(scale * prediction->handAt(t).position); }},
                     computeArrival(duration, hasLeft, isThere)};
  });
}

ReachPlan planAlongChord(const experiment::Experiment& experiment, const Vec3& start, const Vec3& target, predict::Criterion criterion,
                         std::optional<double> handMass) {
  const double length = norm(target - start);
  const Vec3 direction = (target - start) / length;
  return planByPrediction(experiment, length, criterion, handMass, [=](double s) { return start + s * direction; });
}

// phi as a function of arc length from `from`, by Simpson's rule on equal parts of phi; beyond `to` the last part's slope goes on.
class ArcTable {
 public:
  ArcTable(const constraints::Curve& curve, double from, double to) : from_(from), step_((to - from) / kParts) {
    const auto speed = [&](double phi) { return norm(constraints::evaluate(curve, phi).rPhi); };
    for (int i = 0; i < kParts; ++i) {
      const double a = from_ + i * step_;
      arc_[i + 1] = arc_[i] + std::abs(step_) / 6 * (speed(a) + 4 * speed(a + step_ / 2) + speed(a + step_));
    }
  }
  double length() const { return arc_[kParts]; }
  double phiAt(double s) const {
    const auto above = std::upper_bound(arc_.begin(), arc_.end(), s);
    const auto i = std::clamp<std::ptrdiff_t>(above - arc_.begin() - 1, 0, kParts - 1);
    const double part = arc_[i + 1] - arc_[i];
    return from_ + step_ * (static_cast<double>(i) + (part > 0 ? (s - arc_[i]) / part : 0));
  }

 private:
  static constexpr int kParts = 4000;
  double from_, step_;
  std::vector<double> arc_ = std::vector<double>(kParts + 1, 0.0);
};

ReachPlan planAlongCurve(const experiment::Experiment& experiment, const constraints::Constraint& constraint, predict::Criterion criterion,
                         std::optional<double> handMass) {
  const ArcTable table(constraint.curve, experiment.task->start[0], experiment.task->target[0]);
  if (!(table.length() > 0)) throw UsageError("task: start and target are the same place");
  return planByPrediction(experiment, table.length(), criterion, handMass,
                          [=](double s) { return constraints::evaluate(constraint.curve, table.phiAt(s)).r; });
}

// Minimum-jerk law 10 x^3 - 15 x^4 + 6 x^5 (Flash and Hogan 1985) with its first two derivatives.
struct MinimumJerk {
  double value, rate, acceleration;
};
MinimumJerk minimumJerkAt(double x) {
  return {x * x * x * (10 + x * (6 * x - 15)), 30 * x * x * (1 - x) * (1 - x), 60 * x * (1 - x) * (1 - 2 * x)};
}

struct Motion {
  Vec3 r, v, a;  // [m], [m/s], [m/s^2]
};

// The minimum-jerk law in the parameters of a curve or surface.
struct ParameterReach {
  constraints::Constraint constraint;
  std::array<double, 2> from{}, by{};

  Motion at(double t, double duration) const {
    const MinimumJerk law = minimumJerkAt(t / duration);
    const double rate = law.rate / duration, change = law.acceleration / (duration * duration);
    const double q = from[0] + by[0] * law.value, u = by[0] * rate;
    if (constraint.kind == constraints::ConstraintKind::Curve) {
      const constraints::CurvePoint p = constraints::evaluate(constraint.curve, q);
      return {p.r, u * p.rPhi, by[0] * change * p.rPhi + u * u * p.rPhiPhi};
    }
    const constraints::SurfacePoint p = constraints::evaluate(constraint.surface, q, from[1] + by[1] * law.value);
    const double w = by[1] * rate;
    return {p.r, u * p.rU + w * p.rV, by[0] * change * p.rU + by[1] * change * p.rV + u * u * p.rUu + 2 * u * w * p.rUv + w * w * p.rVv};
  }
};

ReachPlan planByInverseDynamics(const experiment::Experiment& experiment, const constraints::Constraint& constraint,
                                const trial::ProtocolSettings& place) {
  const experiment::Task& task = *experiment.task;
  const double mass = experiment.object.masses.at(0), stiffness = experiment.coupling->stiffness, viscosity = experiment.object.viscosity;
  ParameterReach reach{constraint};
  for (int k = 0; k < constraint.parameterCount(); ++k) {
    reach.from[k] = task.start[k];
    reach.by[k] = task.target[k] - task.start[k];
  }
  if (reach.by[0] == 0 && reach.by[1] == 0) throw UsageError("task: start and target are the same place");
  return timeForTask(task, [&](double duration) {
    const auto handAt = [=](double t) {
      const Motion m = reach.at(t, duration);
      const Vec3 lead = (mass * m.a + viscosity * m.v) / stiffness;
      return isFinite(lead) ? m.r + lead : m.r;  // at a pole the parameters say nothing of the acceleration
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

ReachPlan makeReachPlan(const experiment::Experiment& experiment, predict::Criterion criterion, std::optional<double> handMass) {
  const constraints::Constraint constraint = constraints::makeConstraint(experiment.constraint);
  const trial::ProtocolSettings place = trial::makeProtocolSettings(experiment, constraint);
  const bool flat = constraint.kind == constraints::ConstraintKind::Free || constraint.straight;
  if (flat && place.start == place.target) throw UsageError("task: start and target are the same place");
  if (flat) return planAlongChord(experiment, place.start, place.target, criterion, handMass);
  const bool flexible =
      experiment.object.kind == experiment::ObjectKind::Chain || experiment.object.kind == experiment::ObjectKind::Parallel;
  if (flexible && constraint.kind == constraints::ConstraintKind::Curve) return planAlongCurve(experiment, constraint, criterion, handMass);
  if (flexible) throw RefusedError("the simulated subject has no plan for several masses on a surface; use one mass, or a curve");
  if (!experiment.coupling || !(experiment.coupling->stiffness > 0))
    throw RefusedError("coupling.stiffness_n_per_m: 0; nothing joins the simulated subject to the object");
  return planByInverseDynamics(experiment, constraint, place);
}

}  // namespace reachlab::devices
