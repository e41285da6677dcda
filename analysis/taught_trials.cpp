#include "analysis/taught_trials.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace reachlab::analysis {

std::map<std::string, TaughtTrials> taughtTrials(const Analysis& analysis) {
  std::map<std::string, TaughtTrials> people;
  for (const AnalyzedTrial& trial : analysis.trials) {
    if (trial.catchTrial || !std::isfinite(trial.measures.maxPerpendicular)) continue;
    TaughtTrials& person = people[trial.key.subject];
    person.trials.push_back(&trial);
    person.rotated = person.rotated || trial.scene.rotation != 0;
    person.fielded = person.fielded || trial.scene.inField;
  }
  std::erase_if(people, [](const auto& entry) { return !entry.second.rotated && !entry.second.fielded; });
  for (auto& [subject, person] : people)
    std::stable_sort(person.trials.begin(), person.trials.end(), [](const AnalyzedTrial* a, const AnalyzedTrial* b) {
      const auto place = [](const AnalyzedTrial& t) { return std::tie(t.key.day, t.key.session, t.key.run, t.key.trial); };
      return place(*a) < place(*b);
    });
  return people;
}

}  // namespace reachlab::analysis
