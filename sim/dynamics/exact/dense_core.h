#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/math/lanes.h"
#include "sim/dynamics/exact/propagator.h"
#include "sim/dynamics/hand/axis_hand.h"

namespace reachlab::dynamics {

/// One exact step of a chain by its propagator of 2N columns. All sizes are known to the compiler, except that N = 0 is known when the
/// scene is compiled.
template <int N>
class DenseCore {
 public:
  using Lanes = reachlab::Lanes<4>;
  static constexpr int kGroups = lanesFor<4>(2 * N);
  static constexpr bool kFixed = N > 0;
  using Column = std::conditional_t<kFixed, std::array<Lanes, kFixed ? kGroups : 1>, std::vector<Lanes>>;
  struct State {
    Column z;
  };

  [[gnu::noinline]] DenseCore(const ObjectModel& model, bool coupled, double dt)
      : n_(model.count()), stiffness_(coupled ? model.handStiffness[0] : 0), damping_(coupled ? model.handDamping[0] : 0) {
    const Propagator propagator = computePropagator(model, coupled, dt);
    for (int j = 0; j < 2 * n_; ++j) columns_.push_back(column({propagator.d.data() + j * 2 * n_, static_cast<std::size_t>(2 * n_)}));
    for (int k = 0; k < kForceTerms; ++k) force_[k] = column(propagator.force[k]);
    gravity_ = column(propagator.gravity);
    if constexpr (kFixed)
      for (int j = 0; j < 2 * N; ++j) fixed_[j] = columns_[j];
  }

  State makeState() const { return {column({})}; }
  void place(State& state, std::span<const double> x, std::span<const double> v) const noexcept {
    for (int i = 0; i < n_; ++i) {
      at(state.z, i) = i > 0 ? x[i] - x[i - 1] : x[0];
      at(state.z, n_ + i) = i > 0 ? v[i] - v[i - 1] : v[0];
    }
  }
  void read(const State& state, std::span<double> x, std::span<double> v) const noexcept {
    for (int i = 0; i < n_; ++i) {
      x[i] = at(state.z, i) + (i > 0 ? x[i - 1] : 0);
      v[i] = at(state.z, n_ + i) + (i > 0 ? v[i - 1] : 0);
    }
  }

  /// `next` must not be `state`. Returns false if the result is not finite.
  bool advance(const State& state, const AxisHand& hand, State& next) const noexcept {
    return withDegree(hand.degree, [&](auto degree) { return advance<degree.value>(state, hand, next); });
  }

 private:
  template <int Degree>
  bool advance(const State& state, const AxisHand& hand, State& next) const noexcept {
    std::array<double, Degree + 1> f;  // [N] on mass 1, by powers of s
    f[0] = hand.extraForce;
    for (int k = 1; k <= Degree; ++k) f[k] = stiffness_ * hand.r(k);
    if (damping_ != 0)
      for (int k = 0; k <= Degree; ++k) f[k] += damping_ * hand.v(k);
    const int groups = kFixed ? kGroups : lanesFor<4>(2 * n_);
    if constexpr (kFixed) {
      std::array<Lanes, kFixed ? kGroups : 1> even = state.z, odd, push;
      for (int g = 0; g < kGroups; ++g) {
        push[g] = mulAdd(f[0], force_[0][g], gravity_[g] * hand.gravity);
        odd[g] = Lanes{};
      }
      for (int k = 1; k <= Degree; ++k)
        for (int g = 0; g < kGroups; ++g) push[g] = mulAdd(f[k], force_[k][g], push[g]);
#pragma GCC unroll 16
      for (int j = 0; j < 2 * N; j += 2)
        for (int g = 0; g < kGroups; ++g) {
          even[g] = mulAdd(j == 0 ? at(state.z, 0) - hand.origin : at(state.z, j), fixed_[j][g], even[g]);
          odd[g] = mulAdd(at(state.z, j + 1), fixed_[j + 1][g], odd[g]);
        }
      Lanes check{};
      for (int g = 0; g < kGroups; ++g) {
        next.z[g] = even[g] + (odd[g] + push[g]);
        check += next.z[g] * 0.0;
      }
      return allZero(check);
    } else {
      for (int g = 0; g < groups; ++g) next.z[g] = mulAdd(f[0], force_[0][g], mulAdd(hand.gravity, gravity_[g], state.z[g]));
      for (int k = 1; k <= Degree; ++k)
        for (int g = 0; g < groups; ++g) next.z[g] = mulAdd(f[k], force_[k][g], next.z[g]);
      for (int j = 0; j < 2 * n_; ++j) {
        const double zj = at(state.z, j) - (j == 0 ? hand.origin : 0);
        for (int g = 0; g < groups; ++g) next.z[g] = mulAdd(zj, columns_[j][g], next.z[g]);
      }
      Lanes check{};
      for (int g = 0; g < groups; ++g) check += next.z[g] * 0.0;
      return allZero(check);
    }
  }

  static double& at(Column& c, int i) noexcept { return reinterpret_cast<double*>(c.data())[i]; }
  static double at(const Column& c, int i) noexcept { return reinterpret_cast<const double*>(c.data())[i]; }
  Column column(std::span<const double> values) const {
    Column c{};
    if constexpr (!kFixed) c.assign(lanesFor<4>(2 * n_), Lanes{});
    for (std::size_t i = 0; i < values.size(); ++i) at(c, static_cast<int>(i)) = values[i];
    return c;
  }

  int n_;
  double stiffness_, damping_;
  std::array<Column, kFixed ? 2 * N : 1> fixed_{};
  std::array<Column, kForceTerms> force_{};
  Column gravity_{};
  std::vector<Column> columns_;
};

}  // namespace reachlab::dynamics
