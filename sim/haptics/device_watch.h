#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "sim/haptics/device.h"

namespace reachlab::haptics {

/// Why force was taken from the hand for good, until the experimenter resets it.
enum class DeviceFault : std::uint8_t {
  None,
  Silent,     // no new report for the device's bound while a trial is armed or moving, whatever the force
  Jump,       // farther than dynamics::kLargestJump in one tick
  Speed,      // the hand is faster than the device's limit
  NotFinite,  // the object's force is not a number
  Stalled,    // no tick was completed for kStallNs while force was on: told by the watchdog
  NoClock,    // the device that drives the clock does not call any more: told by the watchdog
  Device,     // the device says that it failed
};
/// One sentence for a person: the fault of the device with this name, and the remedy.
std::string describe(DeviceFault fault, const std::string& device);

/// The inputs of the watch in one tick beside the sample.
struct WatchContext {
  bool engaged = false;      // a trial is armed or moving: forces act
  std::uint32_t missed = 0;  // periods skipped before this tick
  std::int64_t nowNs = 0;    // monotonic clock
};

/// Looks at every sample of a device that renders force, before anything is computed from it. A sample that it does not believe becomes
/// valid = false. Such a sample is recorded, gives zero force at once and ends the trial as lost. A recorded run therefore replays to the
/// same bits without the watch. A fault is latched until `reset`.
/// A hand that is held still is no fault. Only missing reports are (`DeviceSample::reports`), and only for devices that count them.
/// Haptic thread. Neither allocates nor throws.
class DeviceWatch {
 public:
  explicit DeviceWatch(const DeviceInfo& info) noexcept;

  /// Returns the sample as it may be believed.
  DeviceSample look(DeviceSample sample, const WatchContext& context) noexcept;
  void latch(DeviceFault fault) noexcept;
  DeviceFault fault() const noexcept { return fault_; }
  void reset() noexcept;

 private:
  double speedOver(const Vec3& position, std::int64_t nowNs) noexcept;
  DeviceFault judge(const DeviceSample& sample, const WatchContext& context) noexcept;

  bool guards_;
  double speedLimit_;
  std::int64_t silenceNs_;
  DeviceFault fault_ = DeviceFault::None;
  static constexpr int kWindow = 10;  // [ticks]
  struct Place {
    Vec3 position;  // [m]
    std::int64_t ns = 0;
  };
  std::array<Place, kWindow> window_{};
  int seen_ = 0;         // places since the hand was first seen, lost or reset; counts on modulo the window
  Vec3 last_;            // [m]
  int silentTicks_ = 0;  // in a row without a new report
  std::uint64_t reports_ = 0;
  std::int64_t reportNs_ = 0;
};

}  // namespace reachlab::haptics
