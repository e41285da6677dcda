#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/math/lanes.h"
#include "base/math/matrix.h"
#include "sim/dynamics/exact/dense_core.h"
#include "sim/dynamics/object/end_masses.h"

namespace reachlab::dynamics {

/// Independent oscillators e_j'' + c_j e_j' + w_j^2 e_j = g_j f, four at a time, each by its exact propagator. A parallel object consists
/// of such oscillators. The modes of a chain are oscillators too, and N masses then cost O(N) per step.
class OscillatorCore {
 public:
  static constexpr int kLanes = 4;
  using Lanes = reachlab::Lanes<kLanes>;
  struct State {
    std::vector<Lanes> x, v;
  };

  /// Parallel objects, or chains with damping that the modes diagonalise (canBeModal).
  OscillatorCore(const ObjectModel& model, bool coupled, double dt);

  State makeState() const;
  void place(State& state, std::span<const double> x, std::span<const double> v) const noexcept;
  void read(const State& state, std::span<double> x, std::span<double> v) const noexcept;
  /// Masses 1 and N alone, in O(N), with the bits of read(). Only where hasEnds().
  bool hasEnds() const noexcept { return !endShapes_.empty(); }
  EndPlaces readEnds(const State& state) const noexcept;
  /// `next` must not be `state`. Returns false if the result is not finite.
  bool advance(const State& state, const AxisHand& hand, State& next) const noexcept;

 private:
  /// Full: with an extra force, gravity or a damped hand.
  template <int Degree, bool Full>
  bool advance(const State& state, const AxisHand& hand, State& next) const noexcept;

  struct Group {
    Lanes xx, xv, vx, vv;  // exp(A dt) - 1
    Lanes rest;            // e at rest for a hand at 1 m
    Lanes extraX, extraV, gravityX, gravityV;
    std::array<Lanes, kForceTerms> handX{}, handV{};  // by position coefficients
    std::array<Lanes, kForceTerms> rateX{}, rateV{};  // by velocity coefficients
  };
  /// A chain without damping, extra force or gravity. Each mode turns freely about the position p at which it would follow the polynomial h
  /// of the hand for ever. There p = rest (h - h2/w^2 + h4/w^4), with h2 and h4 the second and fourth derivative of h. A third of the
  /// numbers of a Group, so that 500 modes remain in the cache.
  struct FreeGroup {
    Lanes turn, vx, xv;  // cos(w dt) - 1, -w sin(w dt), sin(w dt)/w
    Lanes rest, period;  // period: 1/w^2 [s^2]
  };
  static constexpr int kFewestFree = 128;   // masses: fewer fit into the cache as Groups
  static constexpr int kFewestEnds = 3;     // masses: fewer have no masses between the ends
  static constexpr int kFreeDegree = 5;     // of the hand's polynomial
  static constexpr double kSlowest = 3e-4;  // w dt below which 1/w^2 would magnify rounding
  // A larger sum of the hand's coefficients of degree 4 and 5 [m] loses digits, because 1/(w dt)^4 magnifies their rounding. A reach of minimum
  // jerk over 0.4 m in a second has 6e-12.
  static constexpr double kMostFourth = 1e-11;
  bool advanceFree(const State& state, const AxisHand& hand, State& next) const noexcept;

  int n_ = 0;
  double dt_ = 0;
  bool damped_ = false;  // the hand's velocity matters
  std::vector<Group> groups_;
  std::vector<FreeGroup> free_;                   // empty where it does not apply
  Eigen::MatrixXd toModes_, toMasses_;            // empty for a parallel object
  std::vector<std::array<double, 2>> endShapes_;  // toMasses_, rows 1 and N, mode by mode; empty for few masses
};

/// True if the modes of K diagonalise the damping to rounding. This holds without damping, for viscosity on equal masses, and for damping
/// proportional to stiffness.
bool canBeModal(const ObjectModel& model);

}  // namespace reachlab::dynamics
