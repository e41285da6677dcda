#pragma once
#include <array>

#include "sim/dynamics/forces.h"
#include "sim/dynamics/plant.h"

namespace reachlab {

/// What every plant has in common: the object, its surroundings, forces and energy from the masses' places, and counters.
class PlantBase : public Plant {
 public:
  explicit PlantBase(ObjectModel model) : model_(std::move(model)) {}

  int massCount() const noexcept override { return model_.count(); }
  void placeAtRest(std::span<const double> q) noexcept override {
    const std::array<double, 3> rest{};
    place(q, std::span(rest).first(q.size()));
  }
  Vec3 couplingForce(const HandSample& hand) const noexcept override {
    std::array<MassState, kMaxMasses> masses;
    const int count = model_.kind == ObjectKind::Parallel ? model_.count() : 1;
    locate({masses.data(), static_cast<std::size_t>(count)});
    Vec3 force;
    for (int i = 0; i < count; ++i) force += handForce(model_, {hand, coupled_, extra_}, masses[i], i);
    return force;
  }
  double energy(const HandSample& hand) const noexcept override {
    std::array<MassState, kMaxMasses> masses;
    locate({masses.data(), static_cast<std::size_t>(model_.count())});
    return computeEnergy(model_, {hand, coupled_, extra_}, masses);
  }
  std::uint64_t rhsEvaluations() const noexcept override { return rhs_; }
  double lastStepFraction() const noexcept override { return fraction_; }

 protected:
  /// Places and velocities (r, v, q, qRate) of the first masses.
  virtual void locate(std::span<MassState> masses) const noexcept = 0;

  ObjectModel model_;
  bool coupled_ = true;
  Vec3 extra_;
  std::uint64_t rhs_ = 0;
  double fraction_ = 1;
};

}  // namespace reachlab
