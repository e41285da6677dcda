#include "sim/predict/arm/arm_prediction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "sim/experiment/experiment.h"
#include "sim/predict/line/flat_output.h"
#include "sim/predict/numerics/hyper_dual.h"
#include "sim/predict/transcription/transcription.h"

namespace reachlab::predict {
namespace {

using std::acos, std::atan2, std::cos, std::sin;

template <class S>
struct JointMotion {  // each joint's angle and its derivatives to the third
  S q1, w1, a1, j1, q2, w2, a2, j2;
};

// Rates of the joint torques; `force` [N] acts from the hand on the object along the line.
template <class S>
std::array<S, 2> computeTorqueRates(const experiment::Arm& arm, const JointMotion<S>& m, const S& force, const S& forceRate) {
  const double l1 = arm.length[0], l2 = arm.length[1], b1 = arm.damping[0], b2 = arm.damping[1], i2 = arm.inertia[1];
  const double alone = arm.inertia[0] + i2 + arm.mass[1] * l1 * l1, coupled = arm.mass[1] * l1 * arm.centre[1];
  const S s2 = sin(m.q2), c2 = cos(m.q2), q12 = m.q1 + m.q2, w12 = m.w1 + m.w2;
  const S bs = coupled * s2, bc = coupled * c2, both = m.w1 + w12;  // both = 2 w1 + w2
  const S high = l1 * sin(m.q1) + l2 * sin(q12), far = l1 * cos(m.q1) * m.w1 + l2 * cos(q12) * w12;
  const S first = (alone + 2.0 * bc) * m.j1 - 2.0 * bs * m.w2 * m.a1 + (i2 + bc) * m.j2 - bs * m.w2 * m.a2 -
                  ((2.0 * m.a1 + m.a2) * m.w2 + both * m.a2) * bs - both * m.w2 * m.w2 * bc + b1 * m.a1 - far * force - high * forceRate;
  const S second = (i2 + bc) * m.j1 - bs * m.w2 * m.a1 + i2 * m.j2 + bc * m.w2 * m.w1 * m.w1 + 2.0 * bs * m.w1 * m.a1 + b2 * m.a2 -
                   l2 * cos(q12) * w12 * force - l2 * sin(q12) * forceRate;
  return {first, second};
}

template <class S>
std::array<S, 2> computeAngles(const experiment::Arm& arm, const S& x, const S& y) {
  const double l1 = arm.length[0], l2 = arm.length[1];
  const S bend = acos((x * x + y * y - (l1 * l1 + l2 * l2)) / S(2 * l1 * l2));
  const S q2 = arm.elbowLeft ? -bend : bend;
  return {atan2(y, x) - atan2(l2 * sin(q2), l1 + l2 * cos(q2)), q2};
}

// Joint motion of a hand that moves along the line: position, velocity, acceleration, jerk along it.
template <class S>
JointMotion<S> computeJointMotion(const experiment::Arm& arm, const S& x, double y, const S& v, const S& a, const S& j) {
  const double l1 = arm.length[0], l2 = arm.length[1];
  JointMotion<S> m;
  const auto angles = computeAngles(arm, x, S(y));
  m.q1 = angles[0], m.q2 = angles[1];
  const S q12 = m.q1 + m.q2, s1 = l1 * sin(m.q1), c1 = l1 * cos(m.q1), s12 = l2 * sin(q12), c12 = l2 * cos(q12);
  const S det = l1 * l2 * sin(m.q2);
  const auto solve = [&](const S& vx, const S& vy, S& first, S& second) {
    first = (c12 * vx + s12 * vy) / det;
    second = -((c1 + c12) * vx + (s1 + s12) * vy) / det;
  };
  solve(v, S(0.0), m.w1, m.w2);
  const S w12 = m.w1 + m.w2, w1w1 = m.w1 * m.w1, w12w12 = w12 * w12;
  solve(a + c1 * w1w1 + c12 * w12w12, s1 * w1w1 + s12 * w12w12, m.a1, m.a2);
  const S turn1 = 3.0 * m.w1 * m.a1, turn12 = 3.0 * w12 * (m.a1 + m.a2), cube1 = w1w1 * m.w1, cube12 = w12w12 * w12;
  solve(j + c1 * turn1 + c12 * turn12 - s1 * cube1 - s12 * cube12, s1 * turn1 + s12 * turn12 + c1 * cube1 + c12 * cube12, m.j1, m.j2);
  return m;
}

// Whether the last terms of a series are nothing beside its largest: more unknowns would not change it.
bool isResolved(const LegendreSeries& velocity) {
  constexpr double kNothing = 1e-10;
  constexpr size_t kLast = 6;
  double largest = 0, last = 0;
  for (size_t k = 0; k < velocity.size(); ++k) {
    largest = std::max(largest, std::abs(velocity[k]));
    if (k + kLast >= velocity.size()) last = std::max(last, std::abs(velocity[k]));
  }
  return last <= kNothing * largest;
}

void requireReach(const experiment::Arm& arm, double x, double y) {
  const double distance = std::hypot(x, y), shortest = std::abs(arm.length[0] - arm.length[1]), longest = arm.length[0] + arm.length[1];
  constexpr double kMargin = 1e-3;  // [m] at a stretched elbow the joint speeds have no bound
  if (distance < shortest + kMargin || distance > longest - kMargin)
    throw RefusedError(fmt::format("the arm cannot reach: the hand would be {:.3f} m from the shoulder, the arm spans {:.3f} to {:.3f} m",
                                   distance, shortest, longest));
}

}  // namespace

std::unique_ptr<Prediction> makeFreeArmPrediction(const experiment::Arm& arm, const ArmTask& task, int massCount, int unknowns) {
  constexpr int kLocals = 8;
  TranscribedProblem problem;
  problem.duration = task.duration;
  problem.residuals = 2;
  for (const auto* end : {&task.start, &task.target}) {
    const double x = (*end)[0] - arm.shoulder[0], y = (*end)[1] - arm.shoulder[1];
    requireReach(arm, x, y);
    const auto q = computeAngles(arm, x, y);
    (end == &task.start ? problem.from : problem.to).assign(q.begin(), q.end());
  }
  problem.takeDerivativesAsLocals();
  problem.residual = residualOf<kLocals>([&arm](const auto& a) {
    using S = std::decay_t<decltype(a[0])>;
    return computeTorqueRates<S>(arm, {a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]}, S(0.0), S(0.0));
  });
  const TranscribedMotion motion = solveFromStarts(problem, unknowns);

  // The hand along the chord, projected on as many Legendre polynomials as resolve it.
  const double dx = task.target[0] - task.start[0], dy = task.target[1] - task.start[1], length = std::hypot(dx, dy);
  const GaussRule rule = makeGaussRule(3 * motion.basis.columns() + 24);
  std::vector<double> speed;
  const LegendreSeries q1 = motion.derivative(0, 0), q2 = motion.derivative(1, 0), w1 = motion.derivative(0, 1),
                       w2 = motion.derivative(1, 1);
  for (const double x : rule.node) {
    const double a1 = valueAt(q1, x), a12 = a1 + valueAt(q2, x), r1 = valueAt(w1, x), r12 = r1 + valueAt(w2, x);
    const double vx = -arm.length[0] * std::sin(a1) * r1 - arm.length[1] * std::sin(a12) * r12;
    const double vy = arm.length[0] * std::cos(a1) * r1 + arm.length[1] * std::cos(a12) * r12;
    speed.push_back((vx * dx + vy * dy) / length);
  }
  const MotionSeries hand = makeSeriesOfVelocity(projectOnLegendre(speed, rule.node, rule.weight), task.duration);
  auto prediction = makeLegendrePrediction(hand, std::vector<MotionSeries>(massCount, hand), task.duration);
  describeMotion(motion, *prediction);
  prediction->warnings.push_back("free arm: the hand carries nothing, the masses go with it; positions are those along the chord");
  return prediction;
}

std::unique_ptr<Prediction> makeLineArmPrediction(const experiment::Arm& arm, const ArmTask& task, const LineObject& object, int unknowns,
                                                  std::span<const Prediction* const> near) {
  constexpr int kLocals = 6;  // h, h', h'', h''', F, F'
  const int n = object.count();
  const double along = task.target[0] > task.start[0] ? 1 : -1, across = task.start[1] - arm.shoulder[1];
  const double start = task.start[0] - arm.shoulder[0];
  requireReach(arm, start, across);
  requireReach(arm, task.target[0] - arm.shoulder[0], across);
  if (start * (task.target[0] - arm.shoulder[0]) < 0) requireReach(arm, 0, across);

  TranscribedProblem problem;
  problem.duration = task.duration;
  problem.order = 2 * n + 3;
  problem.locals = kLocals;
  problem.residuals = 2;
  problem.from = {0};
  problem.to = {std::abs(task.target[0] - task.start[0])};
  const std::vector<FlatPolynomial> node = computeFlatPolynomials(object);
  FlatPolynomial force(problem.order + 1, 0);
  const auto addForce = [&](const FlatPolynomial& row, int order, long double factor) {
    for (size_t k = 0; k < row.size(); ++k) force[k + order] += factor * row[k];
  };
  addForce(node[0], 2, object.handMass);
  addForce(node[0], 1, object.handDamping);
  for (int i = 0; i < n; ++i) {
    addForce(node[i + 1], 2, object.masses[i]);
    addForce(node[i + 1], 1, object.viscosity[i]);
  }
  const size_t width = static_cast<size_t>(problem.order) + 1;
  std::vector<double> local(kLocals * width, 0.0);
  for (size_t m = 0; m < 4; ++m)
    for (size_t k = 0; k < node[0].size(); ++k) local[m * width + k + m] = static_cast<double>(node[0][k]);
  for (size_t k = 0; k < width; ++k) {
    local[4 * width + k] = static_cast<double>(force[k]);
    if (k + 1 < width) local[5 * width + k + 1] = static_cast<double>(force[k]);
  }
  problem.local = {local};
  problem.residual = residualOf<kLocals>([&](const auto& a) {
    using S = std::decay_t<decltype(a[0])>;
    const JointMotion<S> m = computeJointMotion<S>(arm, start + along * a[0], across, along * a[1], along * a[2], along * a[3]);
    return computeTorqueRates<S>(arm, m, along * a[4], along * a[5]);
  });
  std::vector<LegendreSeries> derivative;
  const auto differentiate = [&](const TranscribedMotion& motion) {
    derivative.clear();
    for (int m = 0; m <= problem.order; ++m) derivative.push_back(motion.derivative(0, m));
  };
  const auto apply = [&](const FlatPolynomial& row, int shift) {
    LegendreSeries sum(derivative[0].size(), 0);
    for (size_t k = 0; k < row.size(); ++k)
      for (size_t c = 0; c < derivative[k + shift].size(); ++c) sum[c] += static_cast<double>(row[k]) * derivative[k + shift][c];
    return sum;
  };
  std::optional<TranscribedMotion> found = solveFromNeighbours(problem, near);
  if (found) {
    differentiate(*found);
    if (!isResolved(apply(node[0], 1))) found.reset();  // they were too few for this duration
  }
  if (!found) {
    found = solveFromStarts(problem, unknowns);
    differentiate(*found);
  }
  const TranscribedMotion& motion = *found;
  std::vector<MotionSeries> masses;
  for (const int i : object.source) masses.push_back({apply(node[i + 1], 0), apply(node[i + 1], 1), {}});
  auto prediction = makeLegendrePrediction({apply(node[0], 0), apply(node[0], 1), apply(node[0], 2)}, std::move(masses), task.duration);
  describeMotion(motion, *prediction);
  prediction->unknowns.assign(motion.coefficient[0].begin() + 1, motion.coefficient[0].end());
  return prediction;
}

}  // namespace reachlab::predict
