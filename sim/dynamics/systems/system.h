#pragma once
#include <array>
#include <cmath>
#include <span>

#include "base/math/fused.h"
#include "sim/dynamics/object/numbers.h"
#include "sim/dynamics/object/object_model.h"
#include "sim/dynamics/object/plant.h"

// A System is what a method integrates: a state of kStates numbers (0: known when compiled), the hand as it enters, and
//   rate(hand, y, dy)            the equations of motion (7)
//   kSecondOrder                 y = (q, q'): the first half of dy is the second half of y
//   scale(i)                     the size below which an error of number i counts as absolute
//   place, locate, accelerate    between the state and the masses' places
//   parametrise                  their parameters, where the state is not made of them and finding them costs: only for whoever asks
//   inside(y), reflect(y)        ends of the constraint (kEnds)
// Sizes are template parameters and forces plain members, so that a step has no virtual call and no branch on configuration.

namespace reachlab::dynamics {

template <int N>
inline constexpr int kMassCapacity = N > 0 ? N : experiment::kMaxMasses;

/// Springs and masses as the step wants them; N = 0: as many as the model has. `Parallel`: every mass has its own spring to the hand and
/// no neighbours.
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

}  // namespace reachlab::dynamics
