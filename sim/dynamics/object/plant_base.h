#pragma once
#include <array>
#include <vector>

#include "sim/dynamics/object/forces.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// What every plant has in common: the object, its surroundings, forces and energy from the masses' places, and counters.
class PlantBase : public Plant {
 public:
  explicit PlantBase(ObjectModel model) : model_(std::move(model)), located_(static_cast<std::size_t>(model_.count())) {}

  int massCount() const noexcept override { return model_.count(); }
  void placeAtRest(std::span<const double> q) noexcept override {
    const std::array<double, 3> rest{};
    place(q, std::span(rest).first(q.size()));
  }
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
  /// Places and velocities (r, v) of the first masses; q and qRate where the state is made of them.
  virtual void locate(std::span<MassState> masses) const noexcept = 0;

  ObjectModel model_;
  bool coupled_ = true;
  Vec3 extra_;
  std::uint64_t rhs_ = 0;
  double fraction_ = 1;

  mutable std::vector<MassState> located_;  // room of the scene's size: clearing room for the most masses took most of a tick
};

}  // namespace reachlab::dynamics
