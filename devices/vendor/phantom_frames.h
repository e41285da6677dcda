#pragma once
#include <atomic>
#include <cstdint>

#include "base/system/triple_buffer.h"
#include "devices/vendor/open_haptics_api.h"
#include "sim/haptics/device.h"
#include "sim/haptics/lateness.h"

namespace reachlab::devices {

/// Of a device's frames, as far as they were counted [ns].
struct FrameTimes {
  haptics::LatenessHistogram age;     // from the sample that a force was computed from to that force in effect
  haptics::LatenessHistogram jitter;  // of the ticks: how far two of them were from 1 ms apart
};

/// What the vendor's servo thread does with one device: one call is one frame, position read at its begin, force in effect at its end.
/// Errors of a frame: communication or device fault -> lost for good; force, impulse, velocity or any other -> failed (its own software
/// has taken the force off), until a second has gone by without one; warm motors -> the force is held to the continuous one meanwhile.
/// A library may call late, even after it was told not to: whoever has scheduled one never frees it.
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

  /// Servo thread: a frame, with a tick in it where the device is the clock. Answers the scheduler whether it is to go on.
  std::uint32_t call() noexcept;

  // Haptic thread, which is the servo thread where the device is the clock.
  haptics::DeviceSample read() noexcept;
  void write(const Vec3& force) noexcept;

  /// Controlling thread, before it is scheduled: null: nobody's clock, the tick takes the newest sample.
  void setTick(haptics::HapticDevice::ClockTick tick, void* context) noexcept;
  /// Controlling thread: from here on errors that are this device's are told to it, whoever asks.
  void enlist() noexcept;
  /// Controlling thread: zero force, and no tick is under way any more when it returns. Bounded: a scheduler that does not call is not waited for.
  void stop() noexcept;
  /// Controlling thread, once it is unscheduled: calls that come all the same touch nothing.
  void retire() noexcept;

  // Any thread.
  haptics::DeviceHealth health() const noexcept { return health_.load(std::memory_order_acquire); }
  std::uint32_t lastError() const noexcept { return lastError_.load(std::memory_order_acquire); }
  /// Its forces were switched off: the next force that is none of zero switches them on again.
  void noteForceOff() noexcept { forceOff_.store(true, std::memory_order_release); }
  const FrameTimes& times() const noexcept { return times_; }

 private:
  struct Left {  // by the tick
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
  haptics::DeviceSample sample_;                 // the servo thread's
  haptics::DeviceSample taken_;                  // the haptic thread's
  std::int64_t lastTickNs_ = 0;                  // the haptic thread's
  Left left_;                                    // the servo thread's, as are:
  bool isNew_ = false, readsTransform_ = true;
  int goodFrames_ = 0;  // in a row
  std::atomic<haptics::DeviceHealth> health_{haptics::DeviceHealth::Ready};
  std::atomic<std::uint32_t> lastError_{0}, told_{0};  // told: an error that another device's frame was handed
  std::atomic<bool> stopping_{false}, retired_{false}, inTick_{false}, forceOff_{false};
  std::atomic<int> zeroFrames_{0};
  FrameTimes times_;
};

}  // namespace reachlab::devices
