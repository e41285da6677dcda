#include "analysis/trials/equal_runs.h"

#include <fmt/format.h>

#include <set>

namespace reachlab::analysis {
namespace {

// Of a trial in which the hand moved; empty when it did not, so that there is nothing to compare.
std::string signatureOf(const record::RecordedTrial& trial) {
  if (trial.result.onsetTick == 0 || !(trial.peakHandSpeed > 0)) return {};
  const auto since = [&](std::uint64_t tick) { return static_cast<std::int64_t>(tick - trial.startTick); };
  return fmt::format("{} {} {} {} {} {:a} {:a} {:a} {:a};", static_cast<int>(trial.result.outcome), static_cast<int>(trial.result.reason),
                     trial.planned.catchTrial, since(trial.result.onsetTick), since(trial.result.endTick), trial.peakHandSpeed,
                     trial.handPathLength, trial.peakForce, trial.meanForce);
}

}  // namespace

std::string EqualRuns::twinOf(const std::string& file, const record::RunConfiguration& c,
                              const std::vector<record::RecordedTrial>& trials) {
  std::string moved;
  for (const record::RecordedTrial& trial : trials) moved += signatureOf(trial);
  if (moved.empty()) return {};
  const std::string key =
      fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", c.subject, c.session, c.practice, c.condition, c.experimentText, c.definitionText, moved);
  const auto [known, isNew] = fileOf_.emplace(key, file);
  return isNew ? std::string() : known->second;
}

void EqualRuns::forget(const std::string& file) {
  std::erase_if(fileOf_, [&](const auto& known) { return known.second == file; });
}

int countRepeats(const std::vector<record::RecordedTrial>& trials) {
  std::set<std::string> seen;
  int repeats = 0;
  for (const record::RecordedTrial& trial : trials) {
    const std::string signature = signatureOf(trial);
    if (!signature.empty() && !seen.insert(signature).second) ++repeats;
  }
  return repeats;
}

}  // namespace reachlab::analysis
