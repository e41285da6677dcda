#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "base/system/triple_buffer.h"
#include "sim/haptics/device.h"
#include "sim/haptics/leavable_thread.h"

namespace reachlab::devices {

/// The deflection of a spring-centred device.
struct Deflection {
  Vec3 push;  // -1 … 1 on each axis, world frame
  std::uint32_t buttons = 0;
};

/// A source of deflections. `wait` returns within some milliseconds: true with the newest deflection, false without a deflection. It sets
/// `lost` while the device is gone. One thread of the hand calls it.
class DeflectionSource {
 public:
  virtual ~DeflectionSource() = default;
  virtual bool wait(Deflection& newest, bool& lost) = 0;
};

/// A hand whose speed is steered, for devices that spring back: v = gain × push beyond a dead zone, integrated by the tick. Without a new
/// report the deflection is held for `kHoldTicks`. Then it fades to zero with a time constant of kFadeTicks. At Cue::Place the hand is at
/// the start again, because such a device has no position. Renders no force.
class RateHand final : public haptics::HapticDevice {
 public:
  static constexpr int kHoldTicks = 40, kFadeTicks = 20;
  struct Options {
    double gain = 0.5;       // [m/s] at full push
    double deadZone = 0.05;  // of the full push
    double reach = 0.5;      // [m] largest distance from the start, on each axis
  };
  RateHand(haptics::DeviceInfo info, const Options& options, const Vec3& start, std::shared_ptr<DeflectionSource> source);
  ~RateHand() override;

  haptics::DeviceInfo info() const override { return info_; }
  void cue(haptics::Cue cue) noexcept override;
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3&) noexcept override {}
  haptics::DeviceHealth health() const noexcept override;

 private:
  struct Shared {
    TripleBuffer<Deflection> deflections;
    std::atomic<bool> stopping{false}, lost{false};
  };
  haptics::DeviceInfo info_;
  Options options_;
  Vec3 start_;
  std::shared_ptr<Shared> shared_;
  haptics::LeavableThread thread_;
  haptics::DeviceSample sample_;
  Deflection deflection_;
  int age_ = 0;  // [ticks] of the deflection
};

}  // namespace reachlab::devices
