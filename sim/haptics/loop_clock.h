#pragma once
#include <cstdint>

#include "base/system/os.h"

namespace reachlab::haptics {

/// The monotonic clock by which a loop in real time keeps its deadlines: the computer's. A test brings its own, whose time passes as it says.
/// Called from the haptic thread; neither allocates nor throws.
class LoopClock {
 public:
  virtual ~LoopClock() = default;
  virtual std::int64_t now() noexcept { return os::now(); }  // [ns]
  virtual void sleepUntil(std::int64_t deadlineNs) noexcept { os::sleepUntil(deadlineNs); }
};

}  // namespace reachlab::haptics
