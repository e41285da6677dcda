#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace reachlab::devices {

/// How well a clock serves a device. Times are in seconds.
struct ClockTiming {
  std::string clock;  // "device": its own calls are the clock; "computer": the tick samples it
  double rate = 0;    // [1/s] of ticks
  std::uint64_t ticks = 0, missed = 0;
  double jitterP50 = 0, jitterP99 = 0, jitterMax = 0;  // how far two ticks are from 1 ms apart
  double ageP50 = 0, ageP99 = 0, ageMax = 0;           // from a sample to the force that was computed from it
};

/// Runs the whole tick on the device that `spec` names (make_device.h) for so long, without a force. A PHANToM is measured twice: first by
/// its own clock, then by the computer clock. There the force counts from when it is in effect. Throws FaultError (a simulated device) or
/// ResourceError.
std::vector<ClockTiming> measureLatency(const std::string& spec, double seconds);

}  // namespace reachlab::devices
