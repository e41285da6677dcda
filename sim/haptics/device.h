#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/math/vec3.h"
#include "sim/dynamics/object/mass_state.h"
#include "sim/haptics/hand_guard.h"

namespace reachlab::haptics {

/// The sample of a device at one tick. World frame, SI. A lost device repeats its last sample with valid = false.
struct DeviceSample {
  Vec3 position = {};  // [m] raw, unfiltered
  Vec3 velocity = {};  // [m/s] if the device measures it (hasVelocity)
  std::uint32_t buttons = 0;
  bool hasVelocity = false;
  bool valid = true;
  bool released = false;      // the dead-man switch is open: no force as long as it is
  std::uint64_t reports = 0;  // how many the device has given so far; a held hand repeats its place, not its report. 0: not counted
  std::int64_t takenNs = 0;   // monotonic clock when the newest report came, 0: now
};

/// Properties of a device. Numbers from the device itself replace those of a data sheet.
struct DeviceInfo {
  std::string name = {}, version = {};
  double maxForce = 12;           // [N] instantaneous; an experiment may ask for less, never for more
  double maxContinuousForce = 0;  // [N] that its motors stand for ever; 0: unknown, no budget is kept
  double thermalSeconds = 10;     // [s] time constant of the motors' heat, for the budget
  bool virtualHand = false;       // moves by tick count, so it may run on a virtual clock
  bool rendersForce = false;      // the watch and the watchdog guard it (device_watch.h)
  bool drivesClock = false;       // calls us (startClock) instead of being asked at our own deadlines
  double speedLimit = 3;          // [m/s] of the hand; beyond it the force is latched off
  double silenceLimit = 0.02;     // [s] longest time without a new report while force is felt
  int degreesOfFreedom = 3;       // of the force; of the place where there is none
  double rate = 1000;             // [1/s] of its reports
  double workspaceRadius = 0;     // [m] about `workspaceCentre`; 0: unknown
  // The device as a body, for predictions. 0: unknown.
  double apparentMass = 0;     // [kg] at the handle
  double coulombFriction = 0;  // [N] to move it backwards
  double viscosity = 0;        // [N s/m]
  double scale = 1;            // of its places in the world; the numbers above are as the world sees them
  double resolution = 0;       // [m]
  double stylusMass = 0;       // [kg] that hangs on it and is held by `guards.compensation`
  Vec3 workspaceCentre = {};   // [m]
  bool steered = false;        // a push moves the hand from `workspaceCentre`, where it is put before each trial
  GuardSettings guards = {};
  std::string mapping = {};     // device to world, as JSON (devices/mapping/mapping.h); empty: as it is
  std::string secondPath = {};  // the action of `stopForce`, for messages. Empty: only the device's watchdog protects
};

/// A trial's cue to a hand that is simulated or replayed.
enum class Cue : std::uint8_t {
  Place,  // be at the start, at rest, for the trial that was prepared
  Go,     // the go signal: the hand's own time runs from here
};

/// How a device is, asked at any time.
enum class DeviceHealth : std::uint8_t { Ready, Warm, Lost, Failed };

/// Where the hand comes from and the force goes. Making one opens it (ResourceError where it cannot be had), destroying it writes zero
/// force and closes it. Threads:
///   haptic thread, once a tick: `read`, `write`, `cue`, `see`; they never wait, allocate or throw. A device whose transport may wait
///     is put behind a thread of its own (devices/io/polled_device.h);
///   controlling thread: `info`, `calibrationHint`, `calibrate`, `startClock`, `stopClock`, and `prepareTrial` between trials, while
///     the haptic thread does not touch what it prepares (it is taken over at Cue::Place);
///   any thread: `health`, `stopForce`.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual DeviceInfo info() const = 0;

  /// Trial index from 0, and the scene of the trial. The motion depends on (seed, index, scene) alone unless the device says otherwise.
  virtual void prepareTrial(int /*index*/, int /*scene*/ = 0) {}
  virtual void cue(Cue) noexcept {}
  virtual DeviceSample read() noexcept = 0;
  virtual void write(const Vec3& force) noexcept = 0;
  /// The masses as a person would see them after this tick. For virtual subjects.
  virtual void see(std::span<const dynamics::MassState> /*masses*/) noexcept {}

  /// The device of each hand, the first hand's at index 0. A plain device returns itself. The haptic thread reads and writes each device.
  /// All other calls reach them through this device. Controlling thread.
  virtual std::vector<HapticDevice*> hands() { return {this}; }

  virtual DeviceHealth health() const noexcept { return DeviceHealth::Ready; }
  /// Why it is not ready, or warnings of the last frames, as the device tells them. Empty: nothing to say.
  virtual std::string healthText() const { return {}; }
  /// Instruction to the experimenter before `calibrate` ("hold the stylus in the inkwell"). Empty: the device needs no calibration.
  virtual std::string calibrationHint() const { return {}; }
  /// Takes the present place as the calibration place. Throws ResourceError in the device's words.
  virtual void calibrate() {}

  /// Zero force by another way than `write`, for the moment when the haptic thread hangs. Must not wait for anything that `write` may
  /// hang in. False: there is no such way.
  virtual bool stopForce() noexcept { return false; }

  /// Devices that drive the clock: from now on `tick(context)` is called by the device's own thread at its rate, until `stopClock`
  /// returns. Throws ResourceError.
  using ClockTick = void (*)(void* context) noexcept;
  virtual void startClock(ClockTick /*tick*/, void* /*context*/) {}
  virtual void stopClock() noexcept {}
};

}  // namespace reachlab::haptics
