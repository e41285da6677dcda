#pragma once
#include <array>
#include <atomic>
#include <cstdint>

#include "base/system/os.h"
#include "base/system/spsc_queue.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// The pointer as a hand. Its events come late, in heaps and at 125 to 1000 Hz, but each event knows its time. The hand plays the events
/// back by their own times, `delay()` later, straight from event to event. It follows that motion as a critically damped second-order
/// system of time constant kSmoothing, which smooths the steps of the pixels. The law is x'' = (target - x)/T^2 - 2 x'/T, exact over a
/// tick, with a delay of 2 T. The playback is as late as recent events were (kLeastPlayback to kMostPlayback). It changes its delay by at
/// most kMostDrift of the time's pace. So a window that draws slowly makes the hand later, not rougher. Renders no force.
class MouseDevice final : public haptics::HapticDevice {
 public:
  static constexpr double kSmoothing = 0.008;                            // [s] T
  static constexpr double kLeastPlayback = 0.012, kMostPlayback = 0.15;  // [s]
  static constexpr double kMostDrift = 0.03;

  /// `now` [ns]: the clock of the ticks.
  explicit MouseDevice(const Vec3& at, std::int64_t (*now)() = os::now);
  /// Window's thread, wait-free. The pointer was at this position [m, world frame] when its clock said `eventNs`. That clock may begin at
  /// any time. Values that are not finite are ignored, and so is an event behind 1024 unread events.
  void point(const Vec3& place, std::int64_t eventNs) noexcept;
  /// The present delay [s] from the pointer to the hand. Any thread.
  double delay() const noexcept { return playback_.load(std::memory_order_relaxed) + 2 * kSmoothing; }

  haptics::DeviceInfo info() const override;
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3&) noexcept override {}

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
  // For the tick only.
  static constexpr int kRing = 256;
  std::array<Event, kRing> ring_{};
  int count_ = 0;                    // number of events in the ring, which continues modulo kRing
  std::int64_t offset_ = INT64_MAX;  // [ns] our clock minus the pointer's, by the promptest event
  std::int64_t at_ = 0, last_ = 0;   // [ns] time of the playback, and our clock at the tick before
  double wanted_ = kLeastPlayback;   // [s]
  Vec3 position_, velocity_;
};

}  // namespace reachlab::devices
