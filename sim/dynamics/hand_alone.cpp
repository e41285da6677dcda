#include "sim/dynamics/hand_alone.h"

namespace reachlab::dynamics {
namespace {

class HandAlone final : public Plant {
 public:
  int massCount() const noexcept override { return 1; }
  void place(std::span<const double> q, std::span<const double> rate) noexcept override {
    hand_ = {};
    if (q.size() == 3) hand_.r = {q[0], q[1], q[2]};
    if (rate.size() == 3) hand_.v = {rate[0], rate[1], rate[2]};
  }
  void setExtraForce(const Vec3&) noexcept override {}
  void setCoupled(bool) noexcept override {}

  StepStatus step(const HandSegment&, double) noexcept override { return StepStatus::Ok; }
  bool needsHandVelocity() const noexcept override { return false; }
  void restart() noexcept override {}

  void observe(const HandSample& hand, std::span<MassState> masses) const noexcept override {
    if (hand.valid) {
      hand_.r = hand.position;
      hand_.v = hand.velocity;
    }
    masses[0] = hand_;
  }
  Vec3 couplingForce(const HandSample&) const noexcept override { return {}; }
  double energy(const HandSample&) const noexcept override { return 0; }
  std::uint64_t rhsEvaluations() const noexcept override { return 0; }

 private:
  mutable MassState hand_;  // as it was seen last
};

}  // namespace

std::unique_ptr<Plant> makeHandAlone() { return std::make_unique<HandAlone>(); }

}  // namespace reachlab::dynamics
