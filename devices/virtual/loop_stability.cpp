#include "devices/virtual/loop_stability.h"

#include <algorithm>
#include <cmath>

#include "base/math/butterworth.h"
#include "base/math/eigen_solvers.h"

namespace reachlab::devices {

// State: x, v of the body; x(n-1); the filter's two last inputs and outputs; then the forces that are on their way.
double spectralRadius(const LoopSettings& s) {
  const bool filtered = s.estimator.kind != "difference";
  constexpr int kX = 0, kV = 1, kOldX = 2, kIn1 = 3, kIn2 = 4, kOut1 = 5, kOut2 = 6, kForces = 7;
  const int size = kForces + s.delayTicks;
  using Row = Eigen::RowVectorXd;
  const auto unit = [&](int at) { return Row(Row::Unit(size, at)); };

  const Row difference = (unit(kX) - unit(kOldX)) / s.period;
  Row velocity = difference;
  if (filtered) {  // the low-pass of VelocityEstimator
    const Biquad filter = butterworthLowPass(s.estimator.cutoff, s.period);
    velocity = filter.b[0] * difference + filter.b[1] * unit(kIn1) + filter.b[2] * unit(kIn2) - filter.a[1] * unit(kOut1) -
               filter.a[2] * unit(kOut2);
  }
  const Row force = -s.stiffness * unit(kX) - s.damping * velocity;
  const Row acting = s.delayTicks == 0 ? force : unit(size - 1);

  const Eigen::Matrix2d body{{0, 1}, {-s.handStiffness / s.mass, -s.friction / s.mass}};
  const Eigen::MatrixXd held = heldStep(body, Eigen::Vector2d(0, 1 / s.mass), s.period);
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(size, size);
  step.row(kX) = held(0, 0) * unit(kX) + held(0, 1) * unit(kV) + held(0, 2) * acting;
  step.row(kV) = held(1, 0) * unit(kX) + held(1, 1) * unit(kV) + held(1, 2) * acting;
  step.row(kOldX) = unit(kX);
  step.row(kIn1) = difference;
  step.row(kIn2) = unit(kIn1);
  step.row(kOut1) = velocity;
  step.row(kOut2) = unit(kOut1);
  for (int i = 0; i < s.delayTicks; ++i) step.row(kForces + i) = i == 0 ? force : unit(kForces + i - 1);
  return eigenvalues(step).cwiseAbs().maxCoeff();
}

double passivityMargin(const LoopSettings& s) noexcept {
  return s.friction - (s.stiffness * s.period / 2 * (1 + 2 * s.delayTicks) + std::abs(s.damping));
}

double largestPassiveStiffness(const LoopSettings& s) noexcept {
  return std::max(0.0, 2 * (s.friction - std::abs(s.damping)) / (s.period * (1 + 2 * s.delayTicks)));
}

double largestStableStiffness(LoopSettings settings, double most) {
  const auto stableAt = [&](double stiffness) {
    settings.stiffness = stiffness;
    return isStable(settings);
  };
  if (stableAt(most)) return most;
  double stable = 0, unstable = most;
  while (unstable - stable > 1e-3 * std::max(stable, 1.0)) {
    const double middle = (stable + unstable) / 2;
    (stableAt(middle) ? stable : unstable) = middle;
  }
  return stable;
}

std::vector<StabilityPoint> computeStabilityMap(const DeviceModel& model, const StabilityMapSettings& settings) {
  std::vector<StabilityPoint> map;
  if (!(settings.dampingStep > 0) || !(settings.mostDamping >= 0)) return map;
  for (const double handDamping : settings.handDampings) {
    LoopSettings loop;
    loop.mass = model.mass + settings.handMass;
    loop.friction = model.viscosity + handDamping;
    loop.delayTicks = settings.delayTicks;
    loop.estimator = settings.estimator;
    const auto steps = static_cast<int>(settings.mostDamping / settings.dampingStep + 1e-9);
    for (int i = 0; i <= steps; ++i) {
      loop.damping = i * settings.dampingStep;
      map.push_back({handDamping, loop.damping, largestStableStiffness(loop), largestPassiveStiffness(loop)});
    }
  }
  return map;
}

}  // namespace reachlab::devices
