#include "devices/reach_plan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "constraints/error.h"
#include "sim/trial/protocol.h"

namespace reachlab {
namespace {

// The same object and time on a straight line of this length: what the criteria are defined for.
std::shared_ptr<const Prediction> predictOnLine(const Experiment& experiment, double length, Criterion criterion,
                                                std::optional<double> handMass) {
  Experiment line = experiment;
  line.constraint = {};
  line.constraint.name = "line";
  line.constraint.shape = {{"length_m", length}};
  line.task->start = {0};
  line.task->target = {2 * std::numbers::pi};
  if (line.object.kind == ObjectKind::Body) line.object.kind = ObjectKind::Point;
  PredictOptions options;
  options.handMass = handMass;
  return predict(line, criterion, options);
}

ReachPlan planAlongChord(const Experiment& experiment, const Vec3& start, const Vec3& target, Criterion criterion,
                         std::optional<double> handMass) {
  const double length = norm(target - start);
  const Vec3 direction = (target - start) / length;
  const auto prediction = predictOnLine(experiment, length, criterion, handMass);
  return {prediction->duration, [=](double t) { return start + prediction->handAt(t).position * direction; }};
}

// phi as a function of arc length from `from`, by Simpson's rule on equal parts of phi; beyond `to` the last part's slope goes on.
class ArcTable {
 public:
  ArcTable(const Curve& curve, double from, double to) : from_(from), step_((to - from) / kParts) {
    const auto speed = [&](double phi) { return norm(evaluate(curve, phi).rPhi); };
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

ReachPlan planAlongCurve(const Experiment& experiment, const Constraint& constraint, Criterion criterion, std::optional<double> handMass) {
  const ArcTable table(constraint.curve, experiment.task->start[0], experiment.task->target[0]);
  if (!(table.length() > 0)) throw UsageError("task: start and target are the same place");
  const auto prediction = predictOnLine(experiment, table.length(), criterion, handMass);
  return {prediction->duration, [=](double t) {
            const double s = prediction->handAt(t).position;
            return evaluate(constraint.curve, table.phiAt(s)).r;
          }};
}

// Minimum-jerk law 10 x^3 - 15 x^4 + 6 x^5 (Flash and Hogan 1985) with its first two derivatives.
struct MinimumJerk {
  double value, rate, acceleration;
};
MinimumJerk minimumJerkAt(double x) {
  return {x * x * x * (10 + x * (6 * x - 15)), 30 * x * x * (1 - x) * (1 - x), 60 * x * (1 - x) * (1 - 2 * x)};
}

ReachPlan planByInverseDynamics(const Experiment& experiment, const Constraint& constraint) {
  const Task& task = *experiment.task;
  const double mass = experiment.object.masses.at(0), stiffness = experiment.coupling->stiffness, viscosity = experiment.object.viscosity;
  const double duration = task.duration;
  std::array<double, 2> from{}, by{};
  for (int k = 0; k < constraint.parameterCount(); ++k) from[k] = task.start[k], by[k] = task.target[k] - task.start[k];
  if (by[0] == 0 && by[1] == 0) throw UsageError("task: start and target are the same place");
  return {duration, [=](double t) {
            const MinimumJerk law = minimumJerkAt(t / duration);
            const std::array<double, 2> q{from[0] + by[0] * law.value, from[1] + by[1] * law.value};
            const double rate = law.rate / duration, change = law.acceleration / (duration * duration);
            Vec3 r, v, a;
            if (constraint.kind == ConstraintKind::Curve) {
              const CurvePoint p = evaluate(constraint.curve, q[0]);
              r = p.r;
              v = by[0] * rate * p.rPhi;
              a = by[0] * change * p.rPhi + by[0] * rate * by[0] * rate * p.rPhiPhi;
            } else {
              const SurfacePoint p = evaluate(constraint.surface, q[0], q[1]);
              const double u = by[0] * rate, w = by[1] * rate;
              r = p.r;
              v = u * p.rU + w * p.rV;
              a = by[0] * change * p.rU + by[1] * change * p.rV + u * u * p.rUu + 2 * u * w * p.rUv + w * w * p.rVv;
            }
            const Vec3 lead = (mass * a + viscosity * v) / stiffness;
            return isFinite(lead) ? r + lead : r;  // at a pole the parameters say nothing of the acceleration
          }};
}

}  // namespace

ReachPlan makeReachPlan(const Experiment& experiment, Criterion criterion, std::optional<double> handMass) {
  const Constraint constraint = makeConstraint(experiment.constraint);
  const ProtocolSettings place = makeProtocolSettings(experiment, constraint);
  const bool flat = constraint.kind == ConstraintKind::Free || constraint.straight;
  if (flat && place.start == place.target) throw UsageError("task: start and target are the same place");
  if (flat) return planAlongChord(experiment, place.start, place.target, criterion, handMass);
  const bool flexible = experiment.object.kind == ObjectKind::Chain || experiment.object.kind == ObjectKind::Parallel;
  if (flexible && constraint.kind == ConstraintKind::Curve) return planAlongCurve(experiment, constraint, criterion, handMass);
  if (flexible) throw RefusedError("the simulated subject has no plan for several masses on a surface; use one mass, or a curve");
  if (!experiment.coupling || !(experiment.coupling->stiffness > 0))
    throw RefusedError("coupling.stiffness_n_per_m: 0; nothing joins the simulated subject to the object");
  return planByInverseDynamics(experiment, constraint);
}

}  // namespace reachlab
