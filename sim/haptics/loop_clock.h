#pragma once
#include <cstdint>

#include "base/system/os.h"

namespace reachlab::haptics {

/// The monotonic clock by which a loop in real time keeps its deadlines. Usually the computer's clock. A test uses a clock that it
/// controls. Called from the haptic thread. Neither allocates nor throws.
class LoopClock {
 public:
  virtual ~LoopClock() = default;
  virtual std::int64_t now() noexcept { return os::now(); }  // [ns]
  virtual void sleepUntil(std::int64_t deadlineNs) noexcept { os::sleepUntil(deadlineNs); }
};

}  // namespace reachlab::haptics
