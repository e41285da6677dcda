#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <initializer_list>
#include <span>
#include <string>

#include "base/math/fused.h"
#include "sim/dynamics/object/numbers.h"
#include "sim/dynamics/object/object_model.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// The result of `settle` for a state after a step, before the next step.
enum class Settled { Same, OtherChart, Lost };

/// The functions of a system beyond its equations of motion. Each one is absent unless the system sets it in its `kHas`. The concept
/// Equations compares this list with the functions. A function that is set but missing, misspelt or has other arguments does not compile. A
/// function that exists but is not set does not compile either.
struct Hooks {
  bool ends = false;           // bounded, bounces, inside, meetEnd: the constraint may end
  bool branches = false;       // branch, takeBack, passEnds, turned: behind some ends another formula holds
  bool holding = false;        // anyHeld, release: a mass may rest in a kink
  bool settling = false;       // settle: looks at each new state
  bool losing = false;         // lost: tells where the motion has no continuation
  bool parametrising = false;  // parametrise: finding q and q' costs, and only an observer asks for them
  bool care = false;           // wantsSubSteps, tightening: some places need sub-steps, and smaller errors
  bool pieces = false;         // steepness, isSteep, meetsNarrow: a formula by pieces, steep or narrow in some
  bool sight = false;          // reach, sightCost: how long a sub-step may be that misses nothing
  bool leadRate = false;       // rate(hand, y, dy, lead, speed): |r_phi| of one mass comes with the rates
  bool gliding = false;        // glide: some steps have a closed form
};

namespace systemDetail {
/// True if each function is present exactly when it is declared.
consteval bool agree(bool declared, std::initializer_list<bool> present) {
  for (const bool one : present)
    if (one != declared) return false;
  return true;
}
// clang-format off
template <class S>
concept HooksAgree =
    agree(S::kHas.ends, {requires(const S s) { { s.bounded() } -> std::same_as<bool>; },
                         requires(const S s) { { s.bounces() } -> std::same_as<bool>; },
                         requires(const S s, const typename S::State y) { { s.inside(y) } -> std::same_as<bool>; },
                         requires(const S s, const typename S::State beyond, typename S::State y) { s.meetEnd(beyond, y, true); }}) &&
    agree(S::kHas.branches,
          {requires(const S s) { s.branch(); }, requires(S s, const S before) { s.takeBack(before.branch()); },
           requires(S s, const typename S::State beyond, typename S::State y, const typename S::Hand hand, double dt) {
             { s.passEnds(beyond, y, hand, dt) } -> std::same_as<bool>;
           },
           requires(const S s, const typename S::State y, double dt) { { s.turned(y, y, dt) } -> std::same_as<bool>; }}) &&
    agree(S::kHas.holding, {requires(const S s) { { s.anyHeld() } -> std::same_as<bool>; },
                            requires(S s, const typename S::State y, const typename S::Hand hand) {
                              { s.release(hand, hand, y) } -> std::same_as<bool>;
                            }}) &&
    agree(S::kHas.settling, {requires(S s, const typename S::State before, typename S::State y) {
            { s.settle(before, y) } -> std::same_as<Settled>;
          }}) &&
    agree(S::kHas.losing, {requires(const S s, const typename S::State y) { { s.lost(y) } -> std::same_as<bool>; }}) &&
    agree(S::kHas.parametrising, {requires(const S s, std::span<MassState> masses) { s.parametrise(masses); }}) &&
    agree(S::kHas.care, {requires(const S s, const typename S::State y) { { s.wantsSubSteps(y, 1e-3) } -> std::same_as<bool>; },
                         requires(const S s) { { s.tightening() } -> std::same_as<double>; }}) &&
    agree(S::kHas.pieces, {requires(const S s, const typename S::State y) { { s.steepness(y) } -> std::same_as<double>; },
                           requires(const S s, const typename S::State y) { { s.isSteep(y) } -> std::same_as<bool>; },
                           requires(const S s, const typename S::State y) { { s.meetsNarrow(y, 1e-3) } -> std::same_as<bool>; }}) &&
    agree(S::kHas.sight, {requires(const S s, const typename S::State y) { { s.reach(y, y, 1e-3) } -> std::same_as<double>; },
                          requires(const S s) { { s.sightCost() } -> std::same_as<int>; }}) &&
    agree(S::kHas.leadRate, {requires(const S s, const typename S::Hand hand, const typename S::State y, typename S::State dy, double speed) {
            s.rate(hand, y, dy, 0, speed);
          }}) &&
    agree(S::kHas.gliding, {requires(const S s, const typename S::State y, typename S::State next, double dt) {
            { s.glide(dt, y, next) } -> std::same_as<bool>;
          }});
// clang-format on
}  // namespace systemDetail

/// [m] The size of a usual position, and the unit of position in which a method states its error.
inline constexpr double kTypicalPlace = 0.1;

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
} && systemDetail::HooksAgree<S>;
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

/// The reason for which a step stopped, where a system adds nothing. `noContinuation` is its text for NoContinuation.
inline std::string plainReason(StepStatus status, const char* noContinuation) {
  if (status == StepStatus::AtEnd) return "a mass reached the end of the constraint's domain";
  return status == StepStatus::NoContinuation ? noContinuation : "";
}

template <int N>
inline constexpr int kMassCapacity = N > 0 ? N : experiment::kMaxMasses;

/// Springs and masses in the form that a step needs. N = 0: as many as the model has. `Parallel`: every mass has a separate spring to the
/// hand and no neighbours.
template <int N, bool Parallel>
struct Springs {
  static constexpr int kCapacity = kMassCapacity<N>;
  int count = N;
  std::array<double, kCapacity> inverseMass{}, handStiffness{}, handDamping{};
  std::array<double, kCapacity> stiffness{}, damping{};  // to the next mass
  double viscosity = 0;
  Vec3 gravity, extraForce;

  explicit Springs(const ObjectModel& model) : count(model.count()), viscosity(model.viscosity), gravity(model.gravity) {
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
    if constexpr (Parallel) {
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
