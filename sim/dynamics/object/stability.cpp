#include "sim/dynamics/object/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/eigen_solvers.h"
#include "base/math/elementary.h"

namespace reachlab::dynamics {
namespace {

Eigen::Matrix3d crossMatrix(const Vec3& p) {
  Eigen::Matrix3d m;
  m << 0, -p.z, p.y, p.z, 0, -p.x, -p.y, p.x, 0;
  return m;
}

// At rest, with relaxed springs: M x'' = -B x' - K x for the place and a small turn of the body. The point that a hand holds at p moves by
// H x, with H = [1, -(p x)]. The hand adds k H^T H to K and b H^T H to B.
std::vector<std::complex<double>> computeBodyEigenvalues(const ObjectModel& model) {
  constexpr int n = 6;
  Eigen::MatrixXd spring = Eigen::MatrixXd::Zero(n, n), damper = spring, a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  damper.topLeftCorner(3, 3).diagonal().setConstant(model.viscosity);
  for (const HandSprings& hand : model.hands) {
    Eigen::MatrixXd held(3, n);
    held << Eigen::Matrix3d::Identity(), -crossMatrix(hand.fpOffset);
    spring += hand.stiffness[0] * held.transpose() * held;
    damper += hand.damping[0] * held.transpose() * held;
  }
  const Eigen::Matrix3d inverse = Eigen::Map<const Eigen::Matrix3d>(model.inertia[0].data()).inverse();  // symmetric
  a.topRightCorner(n, n).setIdentity();
  for (const auto& [column, rates] : {std::pair{0, &spring}, std::pair{n, &damper}}) {
    a.block(n, column, 3, n) = -rates->topRows(3) / model.mass[0];
    a.block(n + 3, column, 3, n) = -inverse * rates->bottomRows(3);
  }
  const Eigen::VectorXcd values = eigenvalues(a);
  std::vector<std::complex<double>> modes(values.begin(), values.end());
  // It turns freely about some axes. Such a pair of zeros comes out as the square root of a rounding.
  constexpr double kNone = 1e-6;  // of the fastest mode
  const double fastest = values.cwiseAbs().maxCoeff();
  for (std::complex<double>& mode : modes)
    if (std::abs(mode) < kNone * fastest) mode = 0;
  return modes;
}

}  // namespace

std::vector<std::complex<double>> computeEigenvalues(const ObjectModel& model) {
  if (model.kind == experiment::ObjectKind::Body) return computeBodyEigenvalues(model);
  const int n = model.count();
  if (n > 100) {
    const double fastest = boundFastestMode(model);
    return {{0, fastest}, {-fastest, 0}};
  }
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (int i = 0; i < n; ++i) {
    a(i, n + i) = 1;
    a(n + i, i) -= model.handStiffness[i] / model.mass[i];
    a(n + i, n + i) -= (model.handDamping[i] + model.viscosity) / model.mass[i];
  }
  for (int i = 0; i < static_cast<int>(model.stiffness.size()); ++i)
    for (const auto& [row, other] : {std::pair{i, i + 1}, std::pair{i + 1, i}}) {
      a(n + row, row) -= model.stiffness[i] / model.mass[row];
      a(n + row, other) += model.stiffness[i] / model.mass[row];
      a(n + row, n + row) -= model.damping[i] / model.mass[row];
      a(n + row, n + other) += model.damping[i] / model.mass[row];
    }
  // Velocities in units of the fastest mode balance the blocks.
  const double unit = std::max(1.0, boundFastestMode(model));
  a.topRightCorner(n, n) *= unit;
  a.bottomLeftCorner(n, n) /= unit;
  const Eigen::VectorXcd values = eigenvalues(a);
  return {values.begin(), values.end()};
}

double rk4Amplification(std::complex<double> z) { return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)))); }

bool isRk4Stable(const std::vector<std::complex<double>>& eigenvalues, double step) {
  constexpr double kRounding = 1e-9;  // an undamped slow mode comes out of the solver with a real part of this relative size
  return std::all_of(eigenvalues.begin(), eigenvalues.end(),
                     [&](const auto& value) { return rk4Amplification(value * step) <= 1 + kRounding; });
}

double findRk4StepLimit(const std::vector<std::complex<double>>& eigenvalues) {
  double fastest = 0;
  for (const auto& value : eigenvalues) fastest = std::max(fastest, std::abs(value));
  if (fastest == 0) return std::numeric_limits<double>::infinity();
  double stable = 0, unstable = 4 / fastest;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (stable + unstable);
    (isRk4Stable(eigenvalues, middle) ? stable : unstable) = middle;
  }
  return stable;
}

double predictRk4Error(const std::vector<std::complex<double>>& eigenvalues, double step, double length, double duration) {
  double error = 0;
  for (const auto& value : eigenvalues) {
    const double w = std::abs(value), z = w * step;
    if (w == 0) continue;
    const double amplitude = length * std::min(1.0, 60 / elementary::pow(w * duration, 3));
    error += amplitude * std::min(1.0, elementary::pow(z, 5) / 120 * duration / step);
  }
  return error;
}

}  // namespace reachlab::dynamics
