#include "sim/subjects/model_learner.h"

#include <algorithm>

namespace reachlab::subjects {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Innovations of every step, each divided by its SD, for another model with the same gains.
VectorXd surprises(const FeedbackGains& gains, const TrialTrace& trace, const ArmWorld& world, const SenseSpec& senses, double distance) {
  const SteppedWorld stepped = stepWorld(world, kControlStep);
  const int n = gains.states, p = gains.touch, v = gains.sight, all = gains.estimate(), ny = gains.senses();
  const int touchAt = n, sightAt = n + p * gains.touchDelay, lastTouch = sightAt - p, lastSight = all - v;
  MatrixXd felt = MatrixXd::Zero(p, n);
  felt(0, 0) = felt(1, 1) = 1;
  felt.row(2) = world.contact;
  VectorXd z = VectorXd::Zero(all), next(all), e(ny);
  z(0) = -distance;
  for (int i = 0; i < world.masses; ++i) z(world.place(i)) = -distance;
  const VectorXd felt0 = felt * z.head(n);
  for (int j = 0; j < gains.touchDelay; ++j) z.segment(touchAt + j * p, p) = felt0;
  for (int j = 0; j < gains.sightDelay * v; ++j) z(sightAt + j) = -distance;
  VectorXd out(trace.steps * ny);
  const double sd[] = {senses.position, senses.velocity, senses.force};
  for (int i = 0; i < trace.steps; ++i) {
    const Eigen::Map<const VectorXd> y(trace.sensed.data() + static_cast<std::ptrdiff_t>(i) * ny, ny);
    e.head(p) = y.head(p) - z.segment(lastTouch, p);
    if (v > 0) e.tail(v) = y.tail(v) - z.segment(lastSight, v);
    const int step = std::min(i, gains.steps - 1);
    const Eigen::Map<const MatrixXd> filter(gains.filter.data() + static_cast<std::ptrdiff_t>(step) * all * ny, all, ny);
    next.noalias() = filter * e;
    next.head(n) += stepped.a * z.head(n) + stepped.b * trace.command[static_cast<std::size_t>(i)];
    next.segment(touchAt, p) += felt * z.head(n);
    next.segment(touchAt + p, p * (gains.touchDelay - 1)) += z.segment(touchAt, p * (gains.touchDelay - 1));
    for (int j = 0; j < v; ++j) next(sightAt + j) += z(gains.seen[static_cast<std::size_t>(j)]);
    if (v > 0) next.segment(sightAt + v, v * (gains.sightDelay - 1)) += z.segment(sightAt, v * (gains.sightDelay - 1));
    z.swap(next);
    for (int j = 0; j < ny; ++j) out(i * ny + j) = e(j) / (j < p ? sd[j] : senses.seen);
  }
  return out;
}

}  // namespace

ModelError computeModelStep(const FeedbackGains& gains, const TrialTrace& trace, const ModelError& used, const ArmSpec& arm,
                            const predict::LineObject& object, const SenseSpec& senses, double distance) {
  constexpr double kProbe = 0.02, kDamping = 1.05, kFloor = 20, kMost = 0.3;
  if (trace.steps == 0) return {};
  const auto at = [&](const ModelError& error) { return surprises(gains, trace, makeArmWorld(arm, object, error), senses, distance); };
  const VectorXd r = at(used);
  MatrixXd j(r.size(), 2);
  j.col(0) = (at({used.stiffness + kProbe, used.mass}) - r) / kProbe;
  j.col(1) = (at({used.stiffness, used.mass + kProbe}) - r) / kProbe;
  Eigen::Matrix2d curvature = j.transpose() * j;
  curvature.diagonal() *= kDamping;
  curvature.diagonal().array() += kFloor;
  const Eigen::Vector2d step = -curvature.ldlt().solve(j.transpose() * r);
  if (!step.allFinite()) return {};
  return {std::clamp(step(0), -kMost, kMost), std::clamp(step(1), -kMost, kMost)};
}

void learn(const LearningRates& rates, const ModelError& step, LearntModel& model) {
  for (double ModelError::*of : {&ModelError::stiffness, &ModelError::mass}) {
    model.fast.*of = rates.keepFast * (model.fast.*of) + rates.learnFast * (step.*of);
    model.slow.*of = rates.keepSlow * (model.slow.*of) + rates.learnSlow * (step.*of);
  }
}

}  // namespace reachlab::subjects
