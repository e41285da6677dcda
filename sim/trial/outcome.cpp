#include "sim/trial/outcome.h"

namespace reachlab::trial {

std::string_view nameOf(Outcome outcome) {
  constexpr std::string_view kNames[]{"none", "success", "failure", "aborted", "interrupted"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Outcome::Interrupted) + 1);
  return kNames[static_cast<std::size_t>(outcome)];
}

std::string_view nameOf(Reason reason) {
  constexpr std::string_view kNames[]{"none",        "position", "velocity",     "time_short",        "none",        "force_limit",
                                      "device_lost", "no_onset", "experimenter", "end_of_constraint", "computation", "program",
                                      "early",       "timing",   "no_start",     "peer_lost",         "via"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(kLastReason) + 1);
  return kNames[static_cast<std::size_t>(reason)];
}

bool endsRun(const TrialResult& result) {
  return result.outcome == Outcome::Interrupted && (result.reason == Reason::Experimenter || result.reason == Reason::Program);
}

bool isPutUpAgain(const TrialResult& result) {
  return result.outcome == Outcome::Aborted || (result.outcome == Outcome::Interrupted && !endsRun(result));
}

}  // namespace reachlab::trial
