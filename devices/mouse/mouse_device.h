#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "base/system/os.h"
#include "base/system/spsc_queue.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// The pointer as a hand. Its events come late, in heaps and at 125 to 1000 Hz, but each knows when it happened: the hand plays them back by
/// their own times, `delay()` later, straight from one to the next, and follows that as a critically damped second-order system of time
/// constant kSmoothing (x'' = (target - x)/T^2 - 2 x'/T, exact over a tick; delay 2 T), which takes the pixels' steps off. The playback is as
/// late as events have lately come (kLeastPlayback to kMostPlayback) and is changed by kMostDrift of the time's pace, so that a window that
/// draws slowly makes the hand later and not rougher. Renders no force.
class MouseDevice final : public haptics::HapticDevice {
 public:
  static constexpr double kSmoothing = 0.008;                            // [s] T
  static constexpr double kLeastPlayback = 0.012, kMostPlayback = 0.15;  // [s]
  static constexpr double kMostDrift = 0.03;

  /// `now` [ns]: the clock of the ticks.
  explicit MouseDevice(const Vec3& at, std::int64_t (*now)() = os::now);
  /// Window's thread, wait-free: the pointer was there [m, world frame] when its own clock, whatever that began with, said `eventNs`. Not
  /// finite, or more than 1024 that were not read: ignored.
  void point(const Vec3& place, std::int64_t eventNs) noexcept;
  /// Any thread: from the pointer to the hand at present [s].
  double delay() const noexcept { return playback_.load(std::memory_order_relaxed) + 2 * kSmoothing; }

  haptics::DeviceInfo info() const override;
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3& force) noexcept override;

 private:
  struct Event {
    Vec3 place;             // [m]
    std::int64_t ns = 0;    // the pointer's clock; in the ring: ours
    std::int64_t came = 0;  // [ns] our clock
  };
  void take(const Event& event) noexcept;
  Vec3 played(std::int64_t ns) const noexcept;
  const Event& back(int i) const noexcept { return ring_[static_cast<std::size_t>((count_ - 1 - i + 2 * kRing) % kRing)]; }

  std::int64_t (*now_)();
  SpscQueue<Event, 1024> events_;
  std::atomic<double> playback_{kLeastPlayback};
  // The tick's.
  static constexpr int kRing = 256;
  std::array<Event, kRing> ring_{};
  int count_ = 0;                    // events in the ring, counts on modulo kRing
  std::int64_t offset_ = INT64_MAX;  // [ns] our clock minus the pointer's, as the promptest event says
  std::int64_t at_ = 0, last_ = 0;   // [ns] where the playback is, and our clock at the tick before
  double wanted_ = kLeastPlayback;   // [s]
  Vec3 position_, velocity_;
};

}  // namespace reachlab::devices
