#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace reachlab::devices {

/// How well an OpenHaptics device is served one way. Times in seconds.
struct ClockTiming {
  std::string clock;  // "device": its scheduler is the clock; "computer": the tick samples it
  double rate = 0;    // [1/s] of ticks
  std::uint64_t ticks = 0, missed = 0;
  double jitterP50 = 0, jitterP99 = 0, jitterMax = 0;  // how far two ticks are from 1 ms apart
  double ageP50 = 0, ageP99 = 0, ageMax = 0;           // from a sample to the force that was computed from it in effect
};

/// Both ways one after the other, `seconds` each, with the whole tick and no force. Throws ResourceError.
std::vector<ClockTiming> compareClocks(const std::string& device, double seconds);

}  // namespace reachlab::devices
