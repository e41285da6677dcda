#pragma once
#include <utility>

#include "sim/haptics/device.h"

namespace reachlab::subjects {

inline constexpr double kMostForce = 1000;  // [N] that a simulated hand can be given; an experiment may ask for less

/// A simulated hand whose reaches are prepared between trials. `Reach` has a flag `ready`. Controlling thread: the protected functions. Haptic
/// thread: `cue` and `write`, which do not allocate.
template <class Reach>
class PreparedHand : public haptics::HapticDevice {
 public:
  haptics::DeviceInfo info() const final { return {.name = "simulated", .version = "1", .maxForce = kMostForce, .virtualHand = true}; }
  void cue(haptics::Cue cue) noexcept final {
    if (cue == haptics::Cue::Go) {
      going_ = true;
      return;
    }
    if (prepared_.ready) {
      std::swap(playing_, prepared_);
      prepared_.ready = false;
    }
    placeAtStart();
  }
  void write(const Vec3& force) noexcept final { felt_ = force; }

 protected:
  /// Prepares trial 0 and plays it, for the constructor.
  void prepareFirst() {
    prepareTrial(0);
    std::swap(playing_, prepared_);
    firstIsThere_ = true;
  }
  /// Whether the trial is the one of `prepareFirst`, and is prepared now.
  bool takeFirst(int index) {
    if (!std::exchange(firstIsThere_, false) || index != 0) return false;
    prepared_ = playing_;
    return true;
  }
  virtual void placeAtStart() noexcept = 0;

  Reach prepared_, playing_;
  Vec3 felt_;  // [N]
  bool going_ = false;

 private:
  bool firstIsThere_ = false;  // `playing_` is the reach that trial 0 would have
};

}  // namespace reachlab::subjects
