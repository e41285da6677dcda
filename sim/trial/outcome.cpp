#include "sim/trial/outcome.h"

namespace reachlab::trial {

std::string_view nameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::None: return "none";
    case Outcome::Success: return "success";
    case Outcome::Failure: return "failure";
    case Outcome::Aborted: return "aborted";
    case Outcome::Interrupted: return "interrupted";
  }
  return "none";
}

std::string_view nameOf(Reason reason) {
  switch (reason) {
    case Reason::None: return "none";
    case Reason::Position: return "position";
    case Reason::Velocity: return "velocity";
    case Reason::TimeShort: return "time_short";
    case Reason::ForceLimit: return "force_limit";
    case Reason::DeviceLost: return "device_lost";
    case Reason::NoOnset: return "no_onset";
    case Reason::Experimenter: return "experimenter";
    case Reason::EndOfConstraint: return "end_of_constraint";
    case Reason::Computation: return "computation";
    case Reason::Program: return "program";
    case Reason::Early: return "early";
    case Reason::Timing: return "timing";
    case Reason::NoStart: return "no_start";
    case Reason::PeerLost: return "peer_lost";
    case Reason::Via: return "via";
  }
  return "none";
}

bool endsRun(const TrialResult& result) {
  return result.outcome == Outcome::Interrupted && (result.reason == Reason::Experimenter || result.reason == Reason::Program);
}

bool isPutUpAgain(const TrialResult& result) {
  return result.outcome == Outcome::Aborted || (result.outcome == Outcome::Interrupted && !endsRun(result));
}

}  // namespace reachlab::trial
