#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/math/elementary.h"
#include "sim/dynamics/hand/hand_segment.h"
#include "sim/dynamics/methods/radau_matrix.h"
#include "sim/dynamics/object/numbers.h"
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
      : n_(system.states()), tolerance_(tolerance > 0 ? tolerance : kStiffTolerance),
        stages_(static_cast<std::size_t>(RadauMatrix::kStages * n_)), matrix_(n_) {}
  void restart() noexcept { last_ = 0; }

  StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y0, State& y, std::uint64_t& counted) noexcept {
    State whole(n_), half(n_), end(n_);
    y = y0;
    int rhs = 0;
    double t = 0, h = last_ > 0 ? std::min(last_, dt) : dt;
    while (t < dt) {
      const bool lastPart = t + 1.01 * h >= dt;
      if (lastPart) h = dt - t;
      double error = std::numeric_limits<double>::infinity();
      if (differentiate(system, hand, t, dt, y, rhs) && matrix_.factorise(h) && solve(system, hand, t, h, dt, y, whole, rhs) &&
          matrix_.factorise(h / 2) && solve(system, hand, t, h / 2, dt, y, half, rhs) &&
          solve(system, hand, t + h / 2, h / 2, dt, half, end, rhs)) {
        double sum = 0;
        for (int i = 0; i < n_; ++i) {
          const double part = (end[i] - whole[i]) / 31 / (tolerance_ * (system.scale(i) + std::abs(y[i])));
          sum += part * part + end[i] * 0.0;
        }
        error = std::sqrt(sum / n_);
      }
      const double factor = std::isfinite(error) ? std::clamp(0.9 * elementary::pow(std::max(error, 1e-10), -1.0 / 6), 0.2, 4.0) : 0.25;
      if (error <= 1) {
        t = lastPart ? dt : t + h;
        y = end;
        last_ = lastPart ? std::max(last_, h * factor) : h * factor;
      }
      h *= error <= 1 ? factor : std::min(factor, 0.7);
      if (t < dt && (rhs > kMaxRhsPerTick || t + h == t)) {
        counted += static_cast<std::uint64_t>(rhs);
        last_ = 0;
        return std::isfinite(error) ? StepStatus::Capped : StepStatus::NotFinite;
      }
    }
    counted += static_cast<std::uint64_t>(rhs);
    return StepStatus::Ok;
  }

 private:
  static constexpr double kStiffTolerance = 1e-10;
  static constexpr int kNewtonRounds = 12;

  /// df/dy by differences.
  bool differentiate(const System& system, const HandSegment& hand, double t, double dt, const State& y, int& rhs) noexcept {
    State at = y, f(n_), shifted(n_);
    double* jacobian = matrix_.jacobian();
    const auto now = system.handAt(hand, t / dt);
    system.rate(now, y, f);
    double check = 0;
    for (int j = 0; j < n_; ++j) {
      const double change = 1.5e-8 * (system.scale(j) + std::abs(y[j]));
      at[j] = y[j] + change;
      system.rate(now, at, shifted);
      at[j] = y[j];
      for (int i = 0; i < n_; ++i) check += (jacobian[i * n_ + j] = (shifted[i] - f[i]) / change) * 0.0;
    }
    rhs += n_ + 1;
    return check == 0;
  }

  /// Stage increments Z = h A f(y + Z). The step ends at y + Z_3.
  bool solve(const System& system, const HandSegment& hand, double t, double h, double dt, const State& y, State& end, int& rhs) noexcept {
    std::fill(stages_.begin(), stages_.end(), 0.0);
    std::array<State, 3> f{State(n_), State(n_), State(n_)};
    State at(n_);
    double* right = matrix_.right();
    double before = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kNewtonRounds; ++round) {
      for (int a = 0; a < 3; ++a) {
        for (int i = 0; i < n_; ++i) at[i] = y[i] + stages_[a * n_ + i];
        system.rate(system.handAt(hand, (t + RadauMatrix::kC[a] * h) / dt), at, f[a]);
      }
      rhs += 3;
      for (int a = 0; a < 3; ++a) {
        const double* weight = RadauMatrix::kA[a];
        for (int i = 0; i < n_; ++i)
          right[a * n_ + i] = h * (weight[0] * f[0][i] + weight[1] * f[1][i] + weight[2] * f[2][i]) - stages_[a * n_ + i];
      }
      matrix_.solve();
      double change = 0;
      for (int a = 0; a < 3; ++a)
        for (int i = 0; i < n_; ++i) {
          stages_[a * n_ + i] += right[a * n_ + i];
          change = std::fmax(change, std::abs(right[a * n_ + i]) / (system.scale(i) + std::abs(y[i]))) + right[a * n_ + i] * 0.0;
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
  std::vector<double> stages_;
  RadauMatrix matrix_;
};

}  // namespace reachlab::dynamics
