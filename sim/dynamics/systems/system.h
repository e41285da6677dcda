#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <span>
#include <string>

#include "base/math/fused.h"
#include "sim/dynamics/object/numbers.h"
#include "sim/dynamics/object/object_model.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// The result of `settle` for a state after a step, before the next step.
enum class Settled { Same, OtherChart, Lost };

/// The functions of a system beyond its equations of motion, which are called only where the system sets them in its `kHas`.
struct Hooks {
  bool ends = false;           // bounded, bounces, inside, meetEnd: the constraint may end
  bool branches = false;       // branch, takeBack, passEnds, turned: behind some ends another formula holds
  bool holding = false;        // anyHeld, release: a mass may rest in a kink
  bool settling = false;       // settle: looks at each new state
  bool losing = false;         // lost: tells where the motion has no continuation
  bool parametrising = false;  // parametrise: finding q and q' costs, and only an observer asks for them
  bool care = false;           // wantsSubSteps: some places need sub-steps
  bool careful = false;        // tightening, sightCost: some need smaller errors too, and to look ahead for them costs
  bool pieces = false;         // steepness, isSteep, meetsNarrow: a formula by pieces, steep or narrow in some
  bool sight = false;          // reach: how long a sub-step may be that misses nothing
  bool leadRate = false;       // rate(hand, y, dy, lead, speed): |r_phi| of one mass comes with the rates
  bool gliding = false;        // glide: some steps have a closed form
};

inline constexpr double kTypicalPlace = 0.1;  // [m] the size of a usual position
/// The largest number of right-hand sides in one tick. Beyond it the step is Capped and the force is zero.
/// A tick on a curve with cusps may take more (cusp_adaptive.h).
inline constexpr int kMaxRhsPerTick = 1000;

/// The equations that a method integrates: a state of kStates numbers (0: known when compiled), and the entry of the hand.
///   rate(hand, y, dy)            the equations of motion (7)
///   kSecondOrder                 y = (q, q'): the first half of dy is the second half of y
///   scale(i)                     the size below which an error of number i counts as absolute
///   handAt, handOf               the hand at a share of a step, and as a sample
// clang-format off
template <class S>
concept Equations = requires(const S s, const typename S::State y, typename S::State dy, const HandSegment& hand, const HandSample& sample) {
  requires std::same_as<decltype(S::kHas), const Hooks>;
  requires std::same_as<decltype(S::kStates), const int>;
  requires std::same_as<decltype(S::kSecondOrder), const bool>;
  { s.states() } -> std::same_as<int>;
  { s.handAt(hand, 0.5) } -> std::same_as<typename S::Hand>;
  { s.handOf(sample) } -> std::same_as<typename S::Hand>;
  s.rate(s.handOf(sample), y, dy);
  { s.scale(0) } -> std::same_as<double>;
};
// clang-format on

/// Equations of an object's masses, which a SystemPlant steps.
///   place, locate, accelerate    between the state and the masses' places
///   stopReason                   why a step stopped there, in words
/// Sizes are template parameters and forces plain members, so that a step has no virtual call and no branch on configuration.
template <class S>
concept ObjectSystem = Equations<S> && requires(S s, const S c, const ObjectModel& model, const Vec3& force, typename S::State y,
                                                const typename S::State at, std::span<const double> q, std::span<MassState> masses) {
  s.setExtraForce(force);
  s.setCoupled(model, true);
  s.place(q, q, y);
  c.locate(at, masses);
  c.accelerate(at, at, masses);
  { c.stopReason(StepStatus::AtEnd, at) } -> std::same_as<std::string>;
};

/// Vector i of numbers that are vectors one after the other.
Vec3 at3(const auto& numbers, int i) noexcept { return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]}; }
void put3(auto& numbers, int i, const Vec3& v) noexcept { numbers[3 * i] = v.x, numbers[3 * i + 1] = v.y, numbers[3 * i + 2] = v.z; }

/// The reason for which a step stopped, where a system adds nothing. `noContinuation` is its text for NoContinuation.
inline std::string plainReason(StepStatus status, const char* noContinuation) {
  if (status == StepStatus::AtEnd) return "a mass reached the end of the constraint's domain";
  return status == StepStatus::NoContinuation ? noContinuation : "";
}

/// Puts a mass that is `beyond` an end of [lo, hi] onto it, and turns its rate round if it `bounces`.
inline void putOnEnd(double beyond, double lo, double hi, bool bounces, double& place, double& rate) noexcept {
  const bool low = beyond < lo;
  if (!low && !(beyond > hi)) return;
  place = low ? lo : hi;
  if (bounces) rate = low ? std::abs(rate) : -std::abs(rate);
}

template <int N>
inline constexpr int kMassCapacity = N > 0 ? N : experiment::kMaxMasses;

/// Springs and masses in the form that a step needs. N = 0: as many as the model has.
template <int N>
struct Springs {
  static constexpr int kCapacity = kMassCapacity<N>;
  int count = N;
  bool parallel;  // every mass has a separate spring to the hand and no neighbours
  std::array<double, kCapacity> inverseMass{}, handStiffness{}, handDamping{};
  std::array<double, kCapacity> stiffness{}, damping{};  // to the next mass
  double viscosity = 0;
  Vec3 gravity, extraForce;

  explicit Springs(const ObjectModel& model)
      : count(model.count()), parallel(model.kind == experiment::ObjectKind::Parallel), viscosity(model.viscosity), gravity(model.gravity) {
    for (int i = 0; i < count; ++i) {
      inverseMass[i] = 1 / model.mass[i];
      if (i < static_cast<int>(model.stiffness.size())) {
        stiffness[i] = model.stiffness[i];
        damping[i] = model.damping[i];
      }
    }
    setCoupled(model, true);
  }
  void setCoupled(const ObjectModel& model, bool coupled) noexcept {
    for (int i = 0; i < count; ++i) {
      handStiffness[i] = coupled ? model.handStiffness[i] : 0;
      handDamping[i] = coupled ? model.handDamping[i] : 0;
    }
  }
  constexpr int n() const noexcept {
    if constexpr (N > 0) return N;
    return count;
  }

  /// Forces of hand and neighbours, for places and velocities of any vector type (Vec3, or double on a line).
  template <class V, class Place>
  void push(const V& hand, const V& handVelocity, const Place& r, const Place& v, Place& force) const noexcept {
    if (N == 1 || parallel) {
      for (int i = 0; i < n(); ++i) force[i] = mulAdd(handStiffness[i], hand - r[i], handDamping[i] * (handVelocity - v[i]));
    } else {
      V before = mulAdd(handStiffness[0], hand - r[0], handDamping[0] * (handVelocity - v[0]));
      for (int i = 0; i + 1 < n(); ++i) {
        const V after = mulAdd(stiffness[i], r[i + 1] - r[i], damping[i] * (v[i + 1] - v[i]));
        force[i] = before + after;
        before = V{} - after;
      }
      force[n() - 1] = before;
    }
  }
};

/// The common part of the systems whose hand acts in space and whose forces are those of `TheSprings`.
template <class TheSprings>
struct SpaceSystem {
  using Hand = HandSample;

  TheSprings springs;

  explicit SpaceSystem(const ObjectModel& model) : springs(model) {}
  void setExtraForce(const Vec3& force) noexcept { springs.extraForce = force; }
  void setCoupled(const ObjectModel& model, bool coupled) noexcept { springs.setCoupled(model, coupled); }
  Hand handAt(const HandSegment& hand, double s) const noexcept { return sampleAt(hand, s); }
  Hand handOf(const HandSample& hand) const noexcept { return hand; }
};

}  // namespace reachlab::dynamics
