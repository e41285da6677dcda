#pragma once
#include <cstdint>

namespace reachlab::trial {

/// From the controlling thread to the haptic thread; logged with the tick at which it took effect, so that a run can be re-simulated.
enum class Command : std::uint8_t { None, NextTrial, Abort, Interrupt };

}  // namespace reachlab::trial
