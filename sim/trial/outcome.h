#pragma once
#include <cstdint>
#include <string_view>

namespace reachlab::trial {

enum class Outcome : std::uint8_t { None, Success, Failure, Aborted, Interrupted };
enum class Reason : std::uint8_t {
  None,
  Position,
  Velocity,
  TimeShort,
  ForceLimit = 5,  // 4 is free
  DeviceLost,
  NoOnset,
  Experimenter,
  EndOfConstraint,
  Computation,
  Program,
  Early,     // onset before the go signal, or in a catch trial
  Timing,    // more ticks were missed in the movement than the experiment allows
  NoStart,   // a simulated or replayed hand was never at the start
  PeerLost,  // another station that moves the same object fell silent
  Via,       // a place on the way was not passed
};
inline constexpr Reason kLastReason = Reason::Via;
std::string_view nameOf(Outcome outcome);  // "success", "failure", "aborted", "interrupted"
std::string_view nameOf(Reason reason);    // "position", "velocity", "time_short", …

/// How a trial ended. For a failure: which mass missed which tolerance and by how much.
struct TrialResult {
  Outcome outcome = Outcome::None;
  Reason reason = Reason::None;
  int mass = 0;             // from 1; 0 where no mass is to blame
  double by = 0;            // excess over the tolerance, [m], [m/s] or [s]
  double movementTime = 0;  // [s] t_e, or the time since onset at which the trial ended
  std::uint64_t onsetTick = 0, endTick = 0;
};

/// True if the run ends with this trial, because a person or the end of the program broke it off. A fault of machine or device does not.
bool endsRun(const TrialResult& result);
/// True if the trial says nothing about the subject. It is queued again at the end if the plan asks for it (`repeat_aborted`).
bool isPutUpAgain(const TrialResult& result);

/// From the controlling thread to the haptic thread. It is logged with the tick at which it took effect, so that a run can be simulated
/// again.
enum class Command : std::uint8_t { None, NextTrial, Abort, Interrupt };

/// The state of the trial, recorded with every tick.
enum class Phase : std::uint8_t { Idle, Waiting, Armed, Moving, Done };
/// The square near the top left: neutral before T - dT, green inside T +- dT, red after.
enum class Semaphore : std::uint8_t { Neutral, Green, Red };

}  // namespace reachlab::trial
