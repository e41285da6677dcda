#pragma once
#include <string>

#include "sim/haptics/loop_core.h"
#include "sim/trial/protocol.h"

namespace reachlab::haptics {

inline constexpr double kTimingCheckSeconds = 2;  // [s] how long the loop is watched before a block

/// The verdict on how well this computer keeps time, and on the loop's priority.
struct TimingVerdict {
  bool good = false;      // a movement that missed what the loop has missed so far would count
  bool realTime = false;  // the loop has real-time priority, or the device's own clock
  std::string sentence;   // what was seen, the verdict, and what to do
};

/// Judges the ticks that a loop has missed so far by the limits of a movement. A function of its arguments alone. Any thread.
TimingVerdict judgeTiming(const LoopReport& report, const trial::ProtocolSettings& limits);

}  // namespace reachlab::haptics
