#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>

#include "sim/dynamics/hand/hand_sample.h"
#include "sim/dynamics/object/mass_state.h"
#include "sim/experiment/object_limits.h"
#include "sim/haptics/device.h"
#include "sim/trial/outcome.h"

namespace reachlab::haptics {

/// Counted, shown, recorded.
struct LoopFaults {
  std::uint64_t lateTicks = 0;    // woke more than a period after the deadline
  std::uint64_t missedTicks = 0;  // whole periods that were skipped
  std::uint64_t longestGapNs = 0;
  std::uint64_t droppedRecords = 0;  // the recorder's queue was full
  std::uint64_t clampedTicks = 0;    // the device got less force than the object gave
  std::array<std::uint64_t, dynamics::kStepStatusCount> steps{};
};

/// The state of one hand after one tick.
struct HandState {
  DeviceSample device;        // raw
  dynamics::HandSample hip;   // what the coupling saw
  Vec3 couplingForce;         // [N] on the object, unclamped
  Vec3 feedbackForce;         // [N] to the device, unclamped (the negative)
  Vec3 deviceForce;           // [N] to the device, after the safety layer
  bool clamped = false;       // the safety layer gave less than it was asked for
  bool rendersForce = false;  // the device: what follows is of interest
  DeviceState deviceState = DeviceState::Off;
  std::uint8_t interventions = 0;  // bits of `intervention`
  double portEnergy = 0;           // [J] given by the hand to the program in this trial, as the passivity observer counts
  double work = 0;                 // [J] done by the hand on the object in this trial; counted where several hold it
};

/// The forces of the environment and the cursor after one tick, where the experiment has them.
struct EnvironmentState {
  Vec3 force;                  // [N] on the hand, before the safety layer
  Vec3 cursor;                 // [m]
  bool channelBroken = false;  // in this trial
};

/// The state after one tick without the hands, the masses and the environment.
struct TickHeader {
  std::uint64_t tick = 0;       // since the run's start; simulated time is tick * 1 ms
  std::int64_t measuredNs = 0;  // monotonic clock at the tick, for the record only
  trial::Phase phase = trial::Phase::Idle;
  trial::Semaphore semaphore = trial::Semaphore::Neutral;
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  std::int32_t trial = 0;      // from 1
  bool gone = false;           // the go signal was given
  std::int32_t viaPassed = 0;  // places on the way
  double trialTime = 0;        // [s] since onset; 0 before
  double energy = 0;           // [J]
  trial::TrialResult result;   // valid in phase Done
  LoopFaults faults;
  std::int32_t massCount = 0;
  std::int32_t handCount = 1;
  bool hasEnvironment = false;  // `TickState::environment` is in use
  dynamics::BodyState body;
};

/// The whole state after one tick. It is published to the window and becomes a row of the recording.
struct TickState : TickHeader {
  std::array<HandState, experiment::kMaxHands> hands{};              // the first `handCount`
  std::array<dynamics::MassState, experiment::kMaxMasses> masses{};  // the first `massCount`
  EnvironmentState environment;
};
static_assert(std::is_trivially_copyable_v<TickState>);

/// Copies a state with only the masses and hands that are there, so that the cost follows the scene.
inline void copyState(const TickState& from, TickState& to) noexcept {
  static_assert(sizeof(TickState) == sizeof(TickHeader) + sizeof(from.hands) + sizeof(from.masses) + sizeof(from.environment),
                "a member would not be copied");
  static_cast<TickHeader&>(to) = from;
  std::copy_n(from.hands.data(), from.handCount, to.hands.data());
  std::copy_n(from.masses.data(), from.massCount, to.masses.data());
  if (from.hasEnvironment) to.environment = from.environment;
}

}  // namespace reachlab::haptics
