#include "sim/subjects/plans/partner_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/fault.h"
#include "base/ticks.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/task_places.h"

namespace reachlab::subjects {
namespace {

constexpr int kSubsteps = 10;
constexpr double kStep = kTickSeconds / kSubsteps;
constexpr double kMaxForce = 60;  // [N] that it is given at most

class PartnerHand final : public haptics::HapticDevice {
 public:
  PartnerHand(const PartnerSpec& spec, const Vec3& start, std::size_t mass, std::unique_ptr<haptics::HapticDevice> leader)
      : spec_(spec), start_(start), mass_(mass), leader_(std::move(leader)),
        seen_(static_cast<std::size_t>(std::lround(spec.reaction / kTickSeconds)) + 1, start) {
    rest();
  }

  haptics::DeviceInfo info() const override {
    return {.name = "partner", .version = "1", .maxForce = kMaxForce, .virtualHand = true, .apparentMass = spec_.handMass};
  }
  void prepareTrial(int index, int scene = 0) override {
    if (leader_) leader_->prepareTrial(index, scene);
  }
  void cue(haptics::Cue cue) noexcept override {
    if (leader_) leader_->cue(cue);
    if (cue == haptics::Cue::Place) rest();
  }
  haptics::DeviceSample read() noexcept override {
    const Vec3 from = meant_, to = intention();
    const Vec3 speed = (to - from) / kTickSeconds;
    for (int i = 1; i <= kSubsteps; ++i) {
      const Vec3 meant = from + (static_cast<double>(i) / kSubsteps) * (to - from);
      const Vec3 total = force_ + spec_.stiffness * (meant - place_) + spec_.damping * (speed - speed_);
      speed_ += (kStep / spec_.handMass) * total;
      place_ += kStep * speed_;
    }
    meant_ = to;
    return {.position = place_, .velocity = speed_, .hasVelocity = true};
  }
  void write(const Vec3& force) noexcept override { force_ = isFinite(force) ? force : Vec3{}; }
  void see(std::span<const dynamics::MassState> masses) noexcept override {
    seen_[at_] = masses[mass_].r;
    at_ = (at_ + 1) % seen_.size();
  }

 private:
  void rest() noexcept {
    place_ = meant_ = start_;
    speed_ = force_ = {};
    std::fill(seen_.begin(), seen_.end(), start_);
    at_ = 0;
  }
  Vec3 intention() noexcept {
    switch (spec_.role) {
      case PartnerRole::Leader: return leader_->read().position;
      case PartnerRole::Follower: return seen_[at_];  // the oldest that is kept
      case PartnerRole::Stubborn: break;
    }
    return start_;
  }

  PartnerSpec spec_;
  Vec3 start_;  // [m]
  std::size_t mass_;
  std::unique_ptr<haptics::HapticDevice> leader_;
  std::vector<Vec3> seen_;  // [m] the mass, a ring of one reaction time
  std::size_t at_ = 0;
  Vec3 place_, speed_, force_;  // [m], [m/s], [N]
  Vec3 meant_;                  // [m] where it meant to be at the tick before
};

}  // namespace

std::unique_ptr<haptics::HapticDevice> makePartnerHand(const experiment::CompiledExperiment& experiment, const PartnerSpec& spec,
                                                       std::unique_ptr<haptics::HapticDevice> leader) {
  const std::size_t masses = experiment.experiment().object.masses.size();
  const std::size_t mass = spec.mass > 0 ? static_cast<std::size_t>(spec.mass) - 1 : masses - 1;
  if (mass >= masses)
    throw FaultError(Fault{"device", fmt::format("is a partner that looks at mass {}", spec.mass), fmt::format("1 to {}", masses)});
  return std::make_unique<PartnerHand>(spec, trial::startOf(experiment), mass, std::move(leader));
}

}  // namespace reachlab::subjects
