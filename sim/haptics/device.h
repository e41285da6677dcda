#pragma once
#include <cstdint>
#include <string>

#include "base/vec3.h"

namespace reachlab::haptics {

/// What a device delivers at one tick. World frame, SI. A lost device repeats its last sample with valid = false.
struct DeviceSample {
  Vec3 position;  // [m] raw, unfiltered
  Vec3 velocity;  // [m/s] if the device measures it (hasVelocity)
  std::uint32_t buttons = 0;
  bool hasVelocity = false;
  bool valid = true;
};

struct DeviceInfo {
  std::string name, version;
  double maxForce = 12;           // [N] the limit applied when the experiment gives none
  double maxContinuousForce = 0;  // [N] 0: unknown
  bool virtualHand = false;       // moves by tick count, so it may run on a virtual clock
};

/// A trial's cue to a hand that is simulated or replayed.
enum class Cue : std::uint8_t {
  Place,  // be at the start, at rest, for the trial that was prepared
  Go,     // the go signal: the hand's own time runs from here
};

/// Where the hand comes from and the force goes. `read`, `write` and `cue` are called by the haptic thread once a tick: they never
/// wait, allocate or throw. `prepareTrial` is called between trials by the controlling thread, while the haptic thread does not touch
/// what it prepares (it is taken over at Cue::Place).
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual DeviceInfo info() const = 0;
  /// Trial index from 0; the motion depends on (seed, index) alone.
  virtual void prepareTrial(int /*index*/) {}
  virtual void cue(Cue) noexcept {}
  virtual DeviceSample read() noexcept = 0;
  virtual void write(const Vec3& force) noexcept = 0;
};

}  // namespace reachlab::haptics
