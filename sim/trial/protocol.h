#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/dynamics/object/mass_state.h"
#include "sim/experiment/experiment_fwd.h"
#include "sim/experiment/object_limits.h"
#include "sim/trial/outcome.h"
#include "sim/trial/planned_trial.h"

namespace reachlab::constraints {
struct Constraint;
}

/// The trial as a state machine over ticks of 1 ms. A pure function of its arguments: no clock, no device, no plant.
///
///   from             on                                                     to
///   Idle, Done       NextTrial                                              Waiting   trial + 1, result cleared
///   Waiting          the HIP within armRadius of the start and slower than  Armed     the FP is placed on the HIP
///                    restSpeed for restTicks, not counting the tick of
///                    NextTrial itself
///   Armed            onset (the HIP has moved more than `onset` from        Moving    t = 0; semaphore neutral
///                    where it was at arming) after the go signal
///   Armed            onset before the go signal, or in a catch trial        Done      failure, early
///   Armed            no onset within `timeout` of the go signal             Done      aborted, no_onset
///   Armed            catch trial: T + dT after the foreperiod               Done      success
///   Moving           all masses within dx and dv, t < T - dT                Done      failure, time_short
///   Moving           all masses within dx and dv, |t - T| <= dT             Done      success
///   Moving           t = T + dT and not all masses within                   Done      failure, via, position or velocity
///   Armed, Moving    the device's force was clamped, if that ends trials    Done      failure, force_limit
///   Armed, Moving    the body ran off the constraint                        Done      failure, end_of_constraint
///   Armed, Moving    a step failed (not finite, capped, no continuation)    Done      aborted, computation
///   Armed, Moving    more ticks missed in the movement, or in one gap of    Done      interrupted, timing
///                    it, than the experiment allows (the gap that onset
///                    lies in is the movement's)
///   Armed, Moving    another station fell silent                            Done      interrupted, peer_lost
///   W., A., M.       the device lost for kLostTicks, or a number of its     Done      interrupted, device_lost
///                    is not finite
///   Waiting          `startTimeout` is over (hands without a person only)   Done      aborted, no_start
///   W., A., M.       Abort / Interrupt                                      Done      aborted / interrupted, experimenter
///
/// Where several hands hold the object, each must be at the start, the one that moves first makes the onset, and losing one loses all.
/// Of several at one tick the lower row of the table wins. Armed begins with the go signal unless the trial has a foreperiod.
/// No mass is within dx and dv before the last mass has passed all places of `via` in their order. It passes a place when the straight line
/// between its positions at two ticks comes within `viaRadius`. On a way that comes back, no mass is within before the last mass has been
/// farther than dx from the target. A trial in which it never was fails by `position`, by what was lacking. At T + dT the reason is `via`
/// if a place was not passed, by its least distance. Otherwise it is `position` while any mass is farther than dx from the target, else
/// `velocity`. The result names the mass with the largest excess in that quantity. The semaphore is green from T - dT on, red once T + dT
/// has passed without success.
namespace reachlab::trial {

inline constexpr std::int64_t kNoLimit = INT64_MAX;
inline constexpr int kLostTicks = 20;  // a driver may skip a packet or two; longer than this the movement is not known any more

/// A task in metres and ticks.
struct ProtocolSettings {
  Vec3 start, target;             // [m] r(start), r(target)
  double armRadius = 0.01;        // [m]
  double onset = 0.001;           // [m]
  std::int64_t restTicks = 0;     // at the start, without a break
  double restSpeed = 1000;        // [m/s] at most, of the estimated velocity
  std::vector<Vec3> via;          // [m] passed in this order
  double viaRadius = 0;           // [m]
  bool comesBack = false;         // a bent way whose target lies within dx of the start, such as a full lap
  double positionTolerance = 0;   // [m] dx
  double velocityTolerance = 0;   // [m/s] dv
  double earliest = 0;            // [s] T - dT
  std::int64_t earliestTick = 0;  // first tick since onset that is not before T - dT
  std::int64_t latestTick = 0;    // last tick since onset that is not after T + dT
  std::int64_t timeoutTicks = 0;
  std::int64_t startTimeoutTicks = kNoLimit;  // until the hand is at the start; a person may take any time
  std::int64_t maxMissedTicks = kNoLimit;     // of one movement
  std::int64_t maxGapTicks = kNoLimit;        // between two ticks of a movement
  bool forceLimitEndsTrial = false;
  bool judgesHand = false;  // there is no object: the one mass is the hand or its cursor, and no mass is named in a result
};

/// Throws FaultError when the experiment has no task, or its start or target is no place on the constraint.
ProtocolSettings makeProtocolSettings(const experiment::Experiment& experiment, const constraints::Constraint& constraint);

/// The inputs of the protocol in one tick.
struct ProtocolInput {
  std::uint64_t tick = 0;
  Command command = Command::None;
  PlannedTrial planned;        // used with NextTrial
  std::span<const Vec3> hips;  // [m] raw, of each hand
  double hipSpeed = 0;         // [m/s] estimated, of the fastest hand
  bool handValid = true;       // every hand is
  bool handBroken = false;     // any device gave something that is not finite
  bool clamped = false;        // any force, at the tick before
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  std::span<const dynamics::MassState> masses;
  std::uint32_t missedTicks = 0;  // whole periods that were skipped before this tick
};

struct ProtocolState {
  Phase phase = Phase::Idle;
  Semaphore semaphore = Semaphore::Neutral;
  std::int32_t trial = 0;  // from 1
  PlannedTrial planned;
  bool gone = false;                                  // the go signal was given
  std::array<Vec3, experiment::kMaxHands> armedAt{};  // [m] the HIPs at arming
  std::uint64_t putUpTick = 0, armedTick = 0, onsetTick = 0;
  std::int64_t restTicks = 0;    // at the start and at rest, in a row
  int lostTicks = 0;             // in a row
  std::int64_t missedTicks = 0;  // of the movement: since onset, with the gap that it lies in
  std::int32_t viaPassed = 0;    // places of `via`
  double viaLeast = 0;           // [m] least distance from the place that comes next
  Vec3 viaFrom = {};             // [m] the last mass at the tick before
  double farthest = 0;           // [m] of the last mass from the target, since onset
  TrialResult result = {};       // in Done
};

/// Haptic thread, once per tick, after the step. Neither allocates nor throws.
void advance(const ProtocolSettings& settings, const ProtocolInput& input, ProtocolState& state) noexcept;

/// Haptic thread: true if the verdict on this tick depends on masses between the first mass and the last mass.
bool needsEveryMass(const ProtocolSettings& settings, const ProtocolState& state, std::uint64_t tick,
                    std::span<const dynamics::MassState> masses) noexcept;

/// Forces act and the object moves.
constexpr bool isEngaged(Phase phase) noexcept { return phase == Phase::Armed || phase == Phase::Moving; }

}  // namespace reachlab::trial
