#include "sim/dynamics/object/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/eigen_solvers.h"
#include "base/math/elementary.h"

namespace reachlab::dynamics {

std::vector<std::complex<double>> computeEigenvalues(const ObjectModel& model) {
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
