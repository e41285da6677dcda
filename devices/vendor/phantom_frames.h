#pragma once
#include <atomic>
#include <cstdint>

#include "base/system/triple_buffer.h"
#include "devices/vendor/open_haptics_api.h"
#include "sim/haptics/device.h"
#include "sim/haptics/lateness.h"

namespace reachlab::devices {

inline constexpr double kMetresPerMm = 1e-3;  // OpenHaptics measures in millimetres

/// Timing of a device's frames [ns].
struct FrameTimes {
  haptics::LatenessHistogram age;     // from the sample behind a force until that force is in effect
  haptics::LatenessHistogram jitter;  // of the ticks: deviation of their spacing from 1 ms
};

/// The work of the vendor's servo thread for one device. One call is one frame: the position is read at its begin, and the force takes
/// effect at its end. After a communication or device fault the device is lost for good. After a force, impulse, velocity or other error it
/// counts as failed, because its software has taken the force off. It recovers after a second without an error. While the motors are warm,
/// the force is limited to the continuous force. A library may call late, even after it was told to stop. So a scheduled object must never
/// be freed.
class PhantomFrames {
 public:
  struct Settings {
    hd::Handle handle = hd::kNoHandle;
    bool deviceVelocity = false, deadMan = false;
    double continuousForce = 0;  // [N] 0: unknown
  };
  PhantomFrames(const hd::Api& hd, const Settings& settings) : hd_(hd), settings_(settings) {}
  PhantomFrames(const PhantomFrames&) = delete;
  PhantomFrames& operator=(const PhantomFrames&) = delete;

  /// Servo thread. Runs a frame, with a tick in it where the device is the clock. Returns whether the scheduler is to continue.
  std::uint32_t call() noexcept;

  // Haptic thread. Where the device is the clock, this is the servo thread.
  haptics::DeviceSample read() noexcept;
  void write(const Vec3& force) noexcept;

  /// Controlling thread, before the object is scheduled. Null: the device is no clock, and the tick takes the newest sample.
  void setTick(haptics::HapticDevice::ClockTick tick, void* context) noexcept;
  /// Controlling thread. From now on this object receives its device's errors, also from the frames of other devices.
  void enlist() noexcept;
  /// Controlling thread. Sets zero force. When it returns, no tick is under way. The wait is bounded, in case the scheduler no longer
  /// calls.
  void stop() noexcept;
  /// Controlling thread, after the object is unscheduled. Later calls of the library then have no effect.
  void retire() noexcept;

  // Any thread.
  haptics::DeviceHealth health() const noexcept { return health_.load(std::memory_order_acquire); }
  std::uint32_t lastError() const noexcept { return lastError_.load(std::memory_order_acquire); }
  /// The forces of the device were switched off. The next force other than zero switches them on again.
  void noteForceOff() noexcept { forceOff_.store(true, std::memory_order_release); }
  const FrameTimes& times() const noexcept { return times_; }

 private:
  struct Left {  // from the tick
    Vec3 force;  // [N]
    std::int64_t leftNs = 0, sampleNs = 0;
  };
  void readFrame() noexcept;
  void writeFrame() noexcept;
  void takeErrors() noexcept;
  void judge(std::uint32_t code) noexcept;

  const hd::Api& hd_;
  const Settings settings_;
  haptics::HapticDevice::ClockTick tick_ = nullptr;
  void* context_ = nullptr;
  TripleBuffer<haptics::DeviceSample> samples_;  // servo -> haptic
  TripleBuffer<Left> forces_;                    // haptic -> servo
  haptics::DeviceSample sample_;                 // for the servo thread
  haptics::DeviceSample taken_;                  // for the haptic thread
  std::int64_t lastTickNs_ = 0;                  // for the haptic thread
  Left left_;                                    // for the servo thread, like the members that follow
  bool isNew_ = false;
  int goodFrames_ = 0;  // in a row
  std::atomic<haptics::DeviceHealth> health_{haptics::DeviceHealth::Ready};
  std::atomic<std::uint32_t> lastError_{0}, told_{0};  // told: an error of this device that another device's frame received
  std::atomic<bool> stopping_{false}, retired_{false}, inTick_{false}, forceOff_{false};
  std::atomic<int> zeroFrames_{0};
  FrameTimes times_;
};

}  // namespace reachlab::devices
