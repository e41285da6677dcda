#pragma once
#include <functional>
#include <vector>

#include "sim/haptics/blind_hand.h"
#include "sim/haptics/device.h"

namespace reachlab::subjects {

/// A hand's motion from the go signal on, with a sample per tick. It rests on the first sample before, and on the last sample afterwards.
struct PlayedReach {
  std::vector<Vec3> position;  // [m]
  std::vector<Vec3> velocity;  // [m/s]; empty: unknown, so it is estimated
};

/// A played reach has at least one sample.
using PlanReach = std::function<PlayedReach(int trial)>;

/// A virtual hand that plays one reach per trial. It moves by tick count, so that the same reaches give the same run at any speed of the
/// clock. Renders no force.
class PlayedHand final : public haptics::HapticDevice, public haptics::BlindHand {
 public:
  /// prepareTrial calls `plan` from the controlling thread. The constructor plans trial 0, so that an impossible plan is reported at the
  /// start.
  PlayedHand(haptics::DeviceInfo info, PlanReach plan);

  haptics::DeviceInfo info() const override { return info_; }
  void prepareTrial(int index, int scene = 0) override;
  void cue(haptics::Cue cue) noexcept override;
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3&) noexcept override {}

 private:
  haptics::DeviceInfo info_;
  PlanReach plan_;
  PlayedReach prepared_;      // for the controlling thread, until Cue::Place
  bool firstIsThere_ = true;  // trial 0 as the constructor planned it
  PlayedReach playing_;
  std::size_t at_ = 0;
  bool going_ = false;
};

}  // namespace reachlab::subjects
