#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>

#include "network/link/link_memory.h"

namespace reachlab::network {

/// The end of a station's trial, as one line.
std::string wordsOf(const LinkEvent& ended);
std::string wordsOf(trial::Outcome outcome, trial::Reason reason);
/// True if something failed at that station, or if somebody ended the trial there. The trial is then over for all stations. A hand that
/// never moves is no such end, because each copy comes to it.
bool isBrokenOff(const LinkEvent& ended);

/// Collects the reports of all stations on the end of the latest trial. The conductor's copy is judged. But a trial that any station broke
/// off is broken off for all stations.
class TrialWords {
 public:
  void add(const LinkEvent& ended);
  /// Whether this trial is the latest trial that any station has ended.
  bool anyOn(std::int32_t trial) const;
  /// The other stations that have not reported the end of this trial: "2, 3". Empty when all have reported. `own` counts from 0.
  std::string missing(std::int32_t trial, int stations, int own) const;
  struct Verdict {
    LinkEvent word;
    bool brokenOff = false;  // the report is from a station that broke off, although the conductor's copy came to a result
  };
  /// nullopt: the conductor has not yet reported this trial. `conducts`: whether a station (from 1) is the conductor.
  std::optional<Verdict> verdictOn(std::int32_t trial, const std::function<bool(std::uint32_t)>& conducts) const;

 private:
  std::array<LinkEvent, kMaxStations> words_{};  // by station, from 0; an event without a station: no report yet
};

}  // namespace reachlab::network
