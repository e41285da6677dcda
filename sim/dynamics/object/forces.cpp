#include "sim/dynamics/object/forces.h"

namespace reachlab::dynamics {

Vec3 netForce(const ObjectModel& model, const Surroundings& around, std::span<const MassState> masses, int i) noexcept {
  const MassState& mass = masses[i];
  Vec3 force = model.mass[i] * model.gravity - model.viscosity * mass.v + handForce(model, around, mass, i);
  if (i == 0) force += around.extraForce;
  if (model.stiffness.empty()) return force;
  const auto pull = [&](int spring, const MassState& other) {
    force += model.stiffness[spring] * (other.r - mass.r) + model.damping[spring] * (other.v - mass.v);
  };
  if (i > 0) pull(i - 1, masses[i - 1]);
  if (i + 1 < model.count()) pull(i, masses[i + 1]);
  return force;
}

double computeEnergy(const ObjectModel& model, const Surroundings& around, std::span<const MassState> masses) noexcept {
  double energy = 0;
  for (int i = 0; i < model.count(); ++i) {
    const MassState& mass = masses[i];
    energy += 0.5 * model.mass[i] * dot(mass.v, mass.v) - model.mass[i] * dot(model.gravity, mass.r);
    if (around.coupled) {
      const Vec3 stretch = around.hand.position - mass.r;
      energy += 0.5 * model.handStiffness[i] * dot(stretch, stretch);
    }
    if (i < static_cast<int>(model.stiffness.size())) {
      const Vec3 stretch = masses[i + 1].r - mass.r;
      energy += 0.5 * model.stiffness[i] * dot(stretch, stretch);
    }
  }
  return energy;
}

}  // namespace reachlab::dynamics
