#pragma once
#include <cstdint>
#include <vector>

#include "base/math/vec3.h"

namespace reachlab::experiment {

struct Tolerance {
  double position = 0.012;  // [m]
  double velocity = 0.012;  // [m/s]
  double time = 0.5;        // [s]
  bool operator==(const Tolerance&) const = default;
};

/// The rest at the start before a trial is armed. The hand stays there for this time and is slower than this speed.
struct StartRest {
  double seconds = 0.3;  // [s]
  double speed = 0.02;   // [m/s]
  bool operator==(const StartRest&) const = default;
};
inline constexpr StartRest kNoStartRest{0, 1000};  // armed on touching the start

/// The plane in which targets, a cursor and deviations are counted. Horizontal: x to the right, -z forward. Frontal: x to the right, y up.
enum class TaskPlane : std::uint8_t { Horizontal, Frontal };

struct Task {
  std::vector<double> start, target;  // constraint parameters; [m] (three) for a free object
  double duration = 1.35;             // [s] T
  Tolerance tolerance;
  double onset = 0.001;     // [m] t = 0 is when the HIP has moved this far
  double armRadius = 0.01;  // [m]
  double timeout = 10;      // [s] no onset by then: aborted
  StartRest rest;
  TaskPlane plane = TaskPlane::Horizontal;
  std::vector<Vec3> via;    // [m] centres of spheres that the last mass passes in this order before it arrives
  double viaRadius = 0.01;  // [m]
  bool operator==(const Task&) const = default;
};

/// How much time a movement may miss before its trial does not count (trial/protocol.h). The haptic loop counts in whole ticks of 1 ms.
struct TimingLimits {
  int maxMissedTicks = 5;
  double maxGap = 0.02;  // [s] between two ticks
  bool operator==(const TimingLimits&) const = default;
};
inline constexpr TimingLimits kNoTimingLimits{10'000'000, 7200};  // longer than any task may last

}  // namespace reachlab::experiment
