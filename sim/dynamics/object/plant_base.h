#pragma once
#include <vector>

#include "sim/dynamics/object/forces.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// The common part of all plants: the object, its surroundings, counters, and forces and energy from the positions of the masses.
class PlantBase : public Plant {
 public:
  explicit PlantBase(const ObjectModel& model);
  ~PlantBase() override;

  int massCount() const noexcept override { return model_.count(); }
  Vec3 couplingForce(const HandSample& hand) const noexcept override {
    const int count = model_.kind == experiment::ObjectKind::Parallel ? model_.count() : 1;
    const std::span<MassState> masses{located_.data(), static_cast<std::size_t>(count)};
    locate(masses);
    Vec3 force;
    for (int i = 0; i < count; ++i) force += handForce(model_, {hand, coupled_, extra_}, masses[i], i);
    return force;
  }
  double energy(const HandSample& hand) const noexcept override {
    locate(located_);
    return computeEnergy(model_, {hand, coupled_, extra_}, located_);
  }
  std::uint64_t rhsEvaluations() const noexcept override { return rhs_; }
  double lastStepFraction() const noexcept override { return fraction_; }

 protected:
  /// Positions and velocities (r, v) of the first masses. Also q and qRate where the state consists of them.
  virtual void locate(std::span<MassState> masses) const noexcept = 0;

  ObjectModel model_;
  bool coupled_ = true;
  Vec3 extra_;
  std::uint64_t rhs_ = 0;
  double fraction_ = 1;

  mutable std::vector<MassState> located_;  // sized for the scene: clearing the largest size took most of a tick
};

}  // namespace reachlab::dynamics
