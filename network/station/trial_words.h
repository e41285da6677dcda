#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>

#include "network/link/link_memory.h"

namespace reachlab::network {

/// How a station's trial ended, in a line.
std::string wordsOf(const LinkEvent& ended);
std::string wordsOf(trial::Outcome outcome, trial::Reason reason);
/// True where something failed at that station, or somebody ended the trial there: then it is over for all. A hand that never moves is no such
/// end, because each copy comes to it.
bool isBrokenOff(const LinkEvent& ended);

/// What each station says of how its latest trial ended, and what holds for all: the conductor's copy is judged, but a trial that any station
/// broke off is broken off for all.
class TrialWords {
 public:
  void add(const LinkEvent& ended);
  /// Whether the latest that any station has ended is this trial.
  bool anyOn(std::int32_t trial) const;
  /// The other stations, of so many, that have not said how this trial ended: "2, 3"; empty: all have. `own`: from 0.
  std::string missing(std::int32_t trial, int stations, int own) const;
  struct Verdict {
    LinkEvent word;
    bool brokenOff = false;  // the word is of a station that broke off, though the conductor's copy came to a result
  };
  /// nullopt: the conductor has said nothing of this trial. `conducts`: whether a station, from 1, does.
  std::optional<Verdict> verdictOn(std::int32_t trial, const std::function<bool(std::uint32_t)>& conducts) const;

 private:
  std::array<LinkEvent, kMaxStations> words_{};  // by station, from 0; without a station: none yet
};

}  // namespace reachlab::network
