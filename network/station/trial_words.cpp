#include "network/station/trial_words.h"

#include <fmt/format.h>

#include <algorithm>

namespace reachlab::network {

std::string wordsOf(trial::Outcome outcome, trial::Reason reason) {
  return std::string(trial::nameOf(outcome)) + (reason == trial::Reason::None ? "" : fmt::format(" ({})", trial::nameOf(reason)));
}

std::string wordsOf(const LinkEvent& ended) {
  return fmt::format("station {}: trial {} {}, copies apart {:.3f} mm RMS", ended.station, ended.trial,
                     wordsOf(ended.outcome, ended.reason), 1e3 * ended.apart);
}

bool isBrokenOff(const LinkEvent& ended) {
  return ended.outcome == trial::Outcome::Interrupted ||
         (ended.outcome == trial::Outcome::Aborted && ended.reason != trial::Reason::NoOnset && ended.reason != trial::Reason::NoStart);
}

void TrialWords::add(const LinkEvent& ended) { words_.at(ended.station - 1) = ended; }

bool TrialWords::anyOn(std::int32_t trial) const {
  return std::any_of(words_.begin(), words_.end(), [&](const LinkEvent& word) { return word.station != 0 && word.trial == trial; });
}

std::string TrialWords::missing(std::int32_t trial, int stations, int own) const {
  std::string names;
  for (int i = 0; i < stations; ++i)
    if (i != own && words_[static_cast<std::size_t>(i)].trial != trial) names += fmt::format("{}{}", names.empty() ? "" : ", ", i + 1);
  return names;
}

std::optional<TrialWords::Verdict> TrialWords::verdictOn(std::int32_t trial, const std::function<bool(std::uint32_t)>& conducts) const {
  const auto find = [&](const auto& wanted) {
    return std::find_if(words_.begin(), words_.end(),
                        [&](const LinkEvent& word) { return word.station != 0 && word.trial == trial && wanted(word); });
  };
  const auto judge = find([&](const LinkEvent& word) { return conducts(word.station); });
  if (judge == words_.end()) return std::nullopt;
  const auto broken = find(isBrokenOff);
  if (isBrokenOff(*judge) || broken == words_.end()) return Verdict{*judge};
  return Verdict{*broken, true};
}

}  // namespace reachlab::network
