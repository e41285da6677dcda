#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/math/elementary.h"
#include "base/math/matrix.h"
#include "sim/dynamics/hand/hand_segment.h"
#include "sim/dynamics/object/numbers.h"
#include "sim/dynamics/object/step_report.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

/// Radau IIA of order 5, L-stable, for damped light masses on curves, whose modes are too fast for explicit methods. Source: Hairer,
/// Wanner: Solving Ordinary Differential Equations II, IV.8. Simplified Newton on the three stages together. The error of a sub-step comes
/// from a second computation in two halves.
template <Equations System>
class Stiff {
 public:
  using State = typename System::State;
  Stiff(const System& system, double tolerance)
      : n_(system.states()), tolerance_(tolerance > 0 ? tolerance : kStiffTolerance), jacobian_(n_ * n_), stages_(3 * n_),
        matrix_(Eigen::MatrixXd::Identity(3 * n_, 3 * n_)), factors_(matrix_), right_(3 * n_), sorted_(3 * n_) {}
  Stiff(const Stiff&) = delete;  // factors_ points into matrix_
  Stiff& operator=(const Stiff&) = delete;
  void restart() noexcept { last_ = 0; }

  StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y0, State& y, StepReport& report) noexcept {
    State whole(n_), half(n_), end(n_);
    y = y0;
    int rhs = 0;
    double t = 0, h = last_ > 0 ? std::min(last_, dt) : dt;
    report.error = 0;
    while (t < dt) {
      const bool lastPart = t + 1.01 * h >= dt;
      if (lastPart) h = dt - t;
      double error = std::numeric_limits<double>::infinity();
      if (differentiate(system, hand, t, dt, y, rhs) && factorise(h) && solve(system, hand, t, h, dt, y, whole, rhs) && factorise(h / 2) &&
          solve(system, hand, t, h / 2, dt, y, half, rhs) && solve(system, hand, t + h / 2, h / 2, dt, half, end, rhs)) {
        double sum = 0;
        for (int i = 0; i < n_; ++i) {
          const double part = (end[i] - whole[i]) / 31 / (tolerance_ * (system.scale(i) + std::abs(y[i])));
          sum += part * part + end[i] * 0.0;
        }
        error = std::sqrt(sum / n_);
      }
      const double factor = std::isfinite(error) ? std::clamp(0.9 * elementary::pow(std::max(error, 1e-10), -1.0 / 6), 0.2, 4.0) : 0.25;
      if (error <= 1) {
        report.error += tolerance_ * error;
        t = lastPart ? dt : t + h;
        y = end;
        last_ = lastPart ? std::max(last_, h * factor) : h * factor;
      }
      h *= error <= 1 ? factor : std::min(factor, 0.7);
      if (t < dt && (rhs > kMaxRhsPerTick || t + h == t)) {
        report.rhs += static_cast<std::uint64_t>(rhs);
        last_ = 0;
        return std::isfinite(error) ? StepStatus::Capped : StepStatus::NotFinite;
      }
    }
    report.rhs += static_cast<std::uint64_t>(rhs);
    return StepStatus::Ok;
  }

 private:
  static constexpr double kStiffTolerance = 1e-10;
  static constexpr int kNewtonRounds = 12;
  static constexpr double kRoot6 = 2.449489742783178;
  static constexpr double kC[3] = {(4 - kRoot6) / 10, (4 + kRoot6) / 10, 1};
  static constexpr double kA[3][3] = {{(88 - 7 * kRoot6) / 360, (296 - 169 * kRoot6) / 1800, (-2 + 3 * kRoot6) / 225},
                                      {(296 + 169 * kRoot6) / 1800, (88 + 7 * kRoot6) / 360, (-2 - 3 * kRoot6) / 225},
                                      {(16 - kRoot6) / 36, (16 + kRoot6) / 36, 1.0 / 9}};

  /// df/dy by differences.
  bool differentiate(const System& system, const HandSegment& hand, double t, double dt, const State& y, int& rhs) noexcept {
    State at = y, f(n_), shifted(n_);
    const auto now = system.handAt(hand, t / dt);
    system.rate(now, y, f);
    double check = 0;
    for (int j = 0; j < n_; ++j) {
      const double change = 1.5e-8 * (system.scale(j) + std::abs(y[j]));
      at[j] = y[j] + change;
      system.rate(now, at, shifted);
      at[j] = y[j];
      for (int i = 0; i < n_; ++i) check += (jacobian_[i * n_ + j] = (shifted[i] - f[i]) / change) * 0.0;
    }
    rhs += n_ + 1;
    return check == 0;
  }

  /// 1 - h A x J = L U, in place.
  bool factorise(double h) noexcept {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        for (int j = 0; j < n_; ++j)
          for (int i = 0; i < n_; ++i)
            matrix_(a * n_ + i, b * n_ + j) = (a == b && i == j ? 1.0 : 0.0) - h * kA[a][b] * jacobian_[i * n_ + j];
    factors_.compute(matrix_);
    return matrix_.diagonal().cwiseAbs().minCoeff() > 0;
  }

  /// right := (L U)^-1 right, without the temporary for which solve() would allocate memory.
  void substitute() noexcept {
    sorted_.noalias() = factors_.permutationP() * right_;
    matrix_.template triangularView<Eigen::UnitLower>().solveInPlace(sorted_);
    matrix_.template triangularView<Eigen::Upper>().solveInPlace(sorted_);
    right_ = sorted_;
  }

  /// Stage increments Z = h A f(y + Z). The step ends at y + Z_3.
  bool solve(const System& system, const HandSegment& hand, double t, double h, double dt, const State& y, State& end, int& rhs) noexcept {
    std::fill(stages_.begin(), stages_.end(), 0.0);
    std::array<State, 3> f{State(n_), State(n_), State(n_)};
    State at(n_);
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kNewtonRounds; ++round) {
      for (int a = 0; a < 3; ++a) {
        for (int i = 0; i < n_; ++i) at[i] = y[i] + stages_[a * n_ + i];
        system.rate(system.handAt(hand, (t + kC[a] * h) / dt), at, f[a]);
      }
      rhs += 3;
      for (int a = 0; a < 3; ++a)
        for (int i = 0; i < n_; ++i)
          right_[a * n_ + i] = h * (kA[a][0] * f[0][i] + kA[a][1] * f[1][i] + kA[a][2] * f[2][i]) - stages_[a * n_ + i];
      substitute();
      double change = 0;
      for (int a = 0; a < 3; ++a)
        for (int i = 0; i < n_; ++i) {
          stages_[a * n_ + i] += right_[a * n_ + i];
          change = std::fmax(change, std::abs(right_[a * n_ + i]) / (system.scale(i) + std::abs(y[i]))) + right_[a * n_ + i] * 0.0;
        }
      if (!std::isfinite(change)) return false;
      if (change < 1e-3 * tolerance_) break;
      if (round > 3 && change > 0.9 * before && change > tolerance_) return false;
      before = change;
    }
    for (int i = 0; i < n_; ++i) end[i] = y[i] + stages_[2 * n_ + i];
    return true;
  }

  int n_;
  double tolerance_;
  double last_ = 0;
  std::vector<double> jacobian_, stages_;
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> factors_;  // of matrix_, in its place
  Eigen::VectorXd right_, sorted_;
};

}  // namespace reachlab::dynamics
