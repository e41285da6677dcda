#include "sim/subjects/plans/played_hand.h"

#include <utility>

namespace reachlab::subjects {

PlayedHand::PlayedHand(haptics::DeviceInfo info, PlanReach plan) : info_(std::move(info)), plan_(std::move(plan)), prepared_(plan_(0)) {
  info_.virtualHand = true;
  if (prepared_.position.empty()) return;
  playing_.position.assign(1, prepared_.position.front());  // at rest there until the first trial
  if (!prepared_.velocity.empty()) playing_.velocity.assign(1, {});
}

void PlayedHand::prepareTrial(int index, int /*scene*/) {
  if (index != 0 || !firstIsThere_) prepared_ = plan_(index);
  firstIsThere_ = false;
}

void PlayedHand::cue(haptics::Cue cue) noexcept {
  if (cue == haptics::Cue::Go) {
    going_ = true;
    return;
  }
  std::swap(playing_, prepared_);
  at_ = 0;
  going_ = false;
}

haptics::DeviceSample PlayedHand::read() noexcept {
  haptics::DeviceSample sample;
  if (playing_.position.empty()) {
    sample.valid = false;
    return sample;
  }
  const std::size_t last = playing_.position.size() - 1;
  if (going_ && at_ < last) ++at_;
  sample.position = playing_.position[at_];
  sample.hasVelocity = !playing_.velocity.empty();
  if (sample.hasVelocity && at_ > 0 && at_ < last) sample.velocity = playing_.velocity[at_];
  return sample;
}

}  // namespace reachlab::subjects
