#include "sim/subjects/feedback_gains.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace reachlab::subjects {
namespace {

using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr int kSettlingSteps = 200;   // of the hold's stationary cost
constexpr double kKnownStart = 1e-8;  // [SI] variance of the state at the start

std::vector<double> flat(const MatrixXd& m) { return {m.data(), m.data() + m.size()}; }

/// The controller's recursion, back from the hold.
std::vector<RowVectorXd> controlGains(const SteppedWorld& world, const MatrixXd& hold, const MatrixXd& move, double effort,
                                      double motorNoise, int moveSteps, int steps) {
  MatrixXd s = 10 * (hold + move);
  const auto back = [&](const MatrixXd& q) {
    const VectorXd sb = s * world.b;
    const double spent = world.b.dot(sb);
    const RowVectorXd gain = (sb.transpose() * world.a) / (effort + (1 + motorNoise * motorNoise) * spent);
    MatrixXd before = q + world.a.transpose() * s * world.a - world.a.transpose() * sb * gain;
    s = 0.5 * (before + before.transpose());
    return gain;
  };
  for (int i = 0; i < kSettlingSteps; ++i) back(hold + move);
  std::vector<RowVectorXd> gains(static_cast<std::size_t>(steps));
  for (int i = steps - 1; i >= 0; --i) gains[static_cast<std::size_t>(i)] = back(i >= moveSteps ? MatrixXd(hold + move) : move);
  return gains;
}

}  // namespace

RowVectorXd criterionRow(const ArmWorld& world, const ArmSpec& arm, double totalMass, predict::Criterion criterion) {
  RowVectorXd row = RowVectorXd::Zero(world.states());
  switch (criterion) {
    case predict::Criterion::MinHandJerk: return world.a.row(1) * world.a;
    case predict::Criterion::MinHandForce:
      row(2) = 1;
      row(1) = -arm.damping;
      return row;
    case predict::Criterion::MinHandForceChange:
      row(3) = 1 / arm.muscle;
      row(2) = -1 / arm.muscle;
      return row;
    case predict::Criterion::MinComAcceleration: return world.netForce / totalMass;
    case predict::Criterion::MinTorqueChange: throw RefusedError("min-torque-change: needs an arm of two links; this subject's is a mass");
    case predict::Criterion::MinCrackle:
    case predict::Criterion::MinHandCrackle: break;
  }
  throw RefusedError(
      fmt::format("{}: asks for a derivative that a muscle of two stages cannot command; allowed: effort, min-hand-jerk, "
                  "min-hand-force, min-hand-force-change, min-com-acceleration",
                  predict::nameOf(criterion)));
}

FeedbackGains computeFeedbackGains(const ArmWorld& world, const ArmSpec& arm, const CostSpec& cost, const SenseSpec& senses,
                                   double motorNoise, double forceNoise) {
  constexpr double kStep = kControlStep;
  const SteppedWorld stepped = stepWorld(world, kStep);
  const int n = world.states(), moveSteps = std::max(1, static_cast<int>(std::lround(cost.duration / kStep)));
  const int steps = moveSteps + std::max(1, static_cast<int>(std::lround(cost.hold / kStep)));

  MatrixXd hold = MatrixXd::Zero(n, n), move = MatrixXd::Zero(n, n);
  const double place = kStep / (cost.position * cost.position), speed = kStep / (cost.velocity * cost.velocity);
  hold(0, 0) = place;
  hold(1, 1) = speed;
  for (int i = 0; i < world.masses; ++i) hold(world.place(i), world.place(i)) = place, hold(world.speed(i), world.speed(i)) = speed;
  if (cost.criterion) {
    const RowVectorXd row = criterionRow(world, arm, 1, *cost.criterion);
    move = cost.criterionWeight * kStep * row.transpose() * row;
  }
  const std::vector<RowVectorXd> gains = controlGains(stepped, hold, move, cost.effort * kStep, motorNoise, moveSteps, steps);

  FeedbackGains out;
  out.states = n;
  out.steps = steps;
  out.touchDelay = senses.touchDelay;
  out.sightDelay = senses.sightDelay;
  if (senses.sight != Sight::None) {
    out.seen.push_back(0);
    for (int i = senses.sight == Sight::All ? 0 : std::max(0, world.masses - 1); i < world.masses; ++i) out.seen.push_back(world.place(i));
  }
  out.sight = static_cast<int>(out.seen.size());
  for (const RowVectorXd& gain : gains) out.control.insert(out.control.end(), gain.data(), gain.data() + n);
  out.advance = flat(stepped.a);
  out.command = flat(stepped.b);
  MatrixXd felt = MatrixXd::Zero(out.touch, n), seen = MatrixXd::Zero(out.sight, n);
  felt(0, 0) = felt(1, 1) = 1;
  felt.row(2) = world.contact;
  for (int j = 0; j < out.sight; ++j) seen(j, out.seen[static_cast<std::size_t>(j)]) = 1;
  for (int j = 0; j < out.touch; ++j)
    for (int k = 0; k < n; ++k) out.felt.push_back(felt(j, k));

  // The mean command, by which the process noise is scaled.
  VectorXd x = VectorXd::Zero(n);
  x(0) = -cost.distance;
  for (int i = 0; i < world.masses; ++i) x(world.place(i)) = -cost.distance;

  const int p = out.touch, v = out.sight, all = out.estimate(), ny = out.senses();
  const int touchAt = n, sightAt = n + p * senses.touchDelay, lastTouch = sightAt - p, lastSight = all - v;
  const auto advance = [&](const MatrixXd& z) {
    MatrixXd next(all, z.cols());
    next.topRows(n) = stepped.a * z.topRows(n);
    next.middleRows(touchAt, p) = felt * z.topRows(n);
    next.middleRows(touchAt + p, p * (senses.touchDelay - 1)) = z.middleRows(touchAt, p * (senses.touchDelay - 1));
    if (v > 0) {
      next.middleRows(sightAt, v) = seen * z.topRows(n);
      next.middleRows(sightAt + v, v * (senses.sightDelay - 1)) = z.middleRows(sightAt, v * (senses.sightDelay - 1));
    }
    return next;
  };
  MatrixXd noise = MatrixXd::Zero(ny, ny);
  noise(0, 0) = senses.position * senses.position;
  noise(1, 1) = senses.velocity * senses.velocity;
  noise(2, 2) = senses.force * senses.force;
  for (int j = 0; j < v; ++j) noise(p + j, p + j) = senses.seen * senses.seen;

  MatrixXd covariance = MatrixXd::Zero(all, all);
  covariance.topLeftCorner(n, n).diagonal().setConstant(kKnownStart);
  out.filter.reserve(static_cast<std::size_t>(steps) * static_cast<std::size_t>(all) * static_cast<std::size_t>(ny));
  for (int i = 0; i < steps; ++i) {
    MatrixXd toSenses(all, ny);
    toSenses << covariance.middleCols(lastTouch, p), covariance.middleCols(lastSight, v);
    MatrixXd sensed(ny, ny);
    sensed << toSenses.middleRows(lastTouch, p), toSenses.middleRows(lastSight, v);
    const MatrixXd gain = toSenses * (sensed + noise).inverse();
    covariance -= gain * toSenses.transpose();
    const MatrixXd predicted = advance(gain);
    out.filter.insert(out.filter.end(), predicted.data(), predicted.data() + predicted.size());
    covariance = advance(MatrixXd(advance(covariance).transpose()));
    const double command = -gains[static_cast<std::size_t>(i)].dot(x.transpose());
    x = stepped.a * x + stepped.b * command;
    const double variance = motorNoise * motorNoise * command * command + forceNoise * forceNoise;
    covariance.topLeftCorner(n, n) += variance * stepped.b * stepped.b.transpose();
  }
  return out;
}

}  // namespace reachlab::subjects
