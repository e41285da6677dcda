#pragma once
#include <cstdint>

#include "sim/haptics/device_watch.h"

namespace reachlab::haptics {

/// The loop as the watchdog sees it at one look.
struct WatchdogView {
  std::int64_t nowNs = 0;
  std::int64_t lastTickNs = 0;  // when the latest tick was completed; 0: none yet
  bool forceOn = false;         // a trial is engaged: the device may be holding a force
  bool drivenByDevice = false;  // its callbacks are the clock
};

inline constexpr std::int64_t kStallNs = 20'000'000;     // without a tick while force is on
inline constexpr std::int64_t kNoClockNs = 500'000'000;  // without a call of a device that drives the clock, at any time

/// The fault to be latched now: Stalled, NoClock or DeviceFault::None. A pure function, so that its law is tested with invented times.
constexpr DeviceFault judgeLoop(const WatchdogView& view) noexcept {
  if (view.lastTickNs == 0) return DeviceFault::None;
  const std::int64_t silence = view.nowNs - view.lastTickNs;
  if (view.forceOn && silence > kStallNs) return DeviceFault::Stalled;
  if (view.drivenByDevice && silence > kNoClockNs) return DeviceFault::NoClock;
  return DeviceFault::None;
}

}  // namespace reachlab::haptics
