#pragma once
#include <cstdint>

namespace reachlab::trial {

/// From the controlling thread to the haptic thread. It is logged with the tick at which it took effect, so that a run can be simulated
/// again.
enum class Command : std::uint8_t { None, NextTrial, Abort, Interrupt };

}  // namespace reachlab::trial
