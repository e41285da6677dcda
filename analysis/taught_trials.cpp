#include "analysis/taught_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
    std::stable_sort(person.trials.begin(), person.trials.end(),
                     [](const AnalyzedTrial* a, const AnalyzedTrial* b) { return recordedBefore(a->key, b->key); });
  return people;
}

Learning learningOf(const TaughtTrials& person) {
  constexpr std::size_t kFew = 5;  // an after-effect fades within some trials
  const auto& trials = person.trials;
  const auto perturbed = [&](const AnalyzedTrial* t) { return person.rotated ? t->scene.rotation != 0 : t->scene.inField; };
  const auto deviation = [&](const AnalyzedTrial* t) {
    return t->isExcluded() ? kNotMeasured : person.rotated ? t->measures.handAngle : t->measures.maxPerpendicular;
  };
  const auto share = [&](const AnalyzedTrial* t) {
    if (t->isExcluded()) return kNotMeasured;
    if (!person.rotated) return t->measures.adaptation;
    return perturbed(t) ? -100 * t->measures.handAngle / t->scene.rotation : kNotMeasured;
  };
  const auto begin = std::find_if(trials.begin(), trials.end(), perturbed);
  const auto end = std::find_if(trials.rbegin(), trials.rend(), perturbed).base();
  const auto late = end - (end - begin) / 4;
  const auto meanOf = [](auto from, auto to, const auto& value, std::size_t most) {
    std::vector<double> values;
    for (auto at = from; at != to && values.size() < most; ++at)
      if (const double v = value(*at); std::isfinite(v)) values.push_back(v);
    return computeMeanSd(values).mean;
  };
  const auto only = [&](bool inTraining) {
    return
        [&, inTraining](const AnalyzedTrial* t) { return !t->scene.channel && perturbed(t) == inTraining ? deviation(t) : kNotMeasured; };
  };
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  Learning out;
  out.plateau = meanOf(late, end, share, kAll);
  const double before = meanOf(trials.begin(), begin, only(false), kAll);
  const double least = std::isfinite(before) ? before : 0;
  out.first = meanOf(begin, end, only(true), kFew) - least;
  out.last = meanOf(late, end, only(true), kAll) - least;
  const double after = meanOf(end, trials.end(), only(false), kFew);
  out.afterEffect = (std::isfinite(after) ? after : meanOf(late, end, only(false), kAll)) - least;
  return out;
}

}  // namespace reachlab::analysis
