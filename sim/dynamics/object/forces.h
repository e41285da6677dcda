#pragma once
#include <span>

#include "sim/dynamics/object/object_model.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// Influences on the object from outside at one instant.
struct Surroundings {
  HandSample hand;
  bool coupled = true;
  Vec3 extraForce;  // [N] on mass 1
};

/// Force of the hand on mass i, Eq. (8) [N].
inline Vec3 handForce(const ObjectModel& model, const Surroundings& around, const MassState& mass, int i) noexcept {
  if (!around.coupled) return {};
  return model.handStiffness[i] * (around.hand.position - mass.r) + model.handDamping[i] * (around.hand.velocity - mass.v);
}
/// Sum of all forces on mass i except the constraint force [N].
Vec3 netForce(const ObjectModel& model, const Surroundings& around, std::span<const MassState> masses, int i) noexcept;
/// Kinetic + elastic (springs and coupling) + gravity energy [J], without the rotation of a body.
double computeEnergy(const ObjectModel& model, const Surroundings& around, std::span<const MassState> masses) noexcept;

}  // namespace reachlab::dynamics
