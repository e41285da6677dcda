#pragma once
#include <atomic>
#include <cstdint>

#include "base/math/vec3.h"
#include "base/system/spsc_queue.h"
#include "base/ticks.h"
#include "sim/haptics/run_sink.h"

namespace reachlab::gui::plot {

/// One tick for the plot. World frame, SI.
struct TracePoint {
  std::uint64_t tick = 0;
  std::int32_t trial = 0;
  trial::Phase phase = trial::Phase::Idle;
  double trialTime = 0;                     // [s] since onset
  Vec3 hand, handVelocity;                  // [m], [m/s]
  Vec3 last, lastVelocity;                  // of the last mass
  double firstQ = 0, lastQ = 0;             // curve parameter of the first and last mass
  double force = 0;                         // [N]
  Vec3 watched = {}, watchedVelocity = {};  // [m], [m/s] of the hand or mass that is watched
  std::int64_t measuredNs = 0;              // by the computer's clock
  std::uint32_t missed = 0;                 // ticks since the point before
};

/// Watches the runs of a session for the window's plot: every fifth tick, without waiting.
class TraceSink final : public haptics::RunSink {
 public:
  static constexpr std::uint64_t kEvery = 5;  // ticks a point

  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept override;
  /// A mass between the ends is computed every fifth tick if it was watched when the run began. Otherwise it comes with the rows of the
  /// recording.
  std::uint32_t massesEvery() const noexcept override { return watched_.load(std::memory_order_relaxed) > 0 ? std::uint32_t{kEvery} : 0; }

  /// Any thread. The watched mass from 0, or -1 for the hand.
  void watch(int mass) noexcept { watched_.store(mass, std::memory_order_relaxed); }
  /// Window's thread: the oldest point not yet taken. Points that the window was too slow for are lost to the plot, not to the record.
  bool tryTake(TracePoint& point) noexcept { return points_.tryPop(point); }

 private:
  SpscQueue<TracePoint, 4096> points_;
  std::atomic<int> watched_{-1};
  std::uint32_t missed_ = 0;  // haptic thread's own
};

}  // namespace reachlab::gui::plot
