#include "analysis/taught_trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "analysis/measures/deviation_and_adaptation.h"

namespace reachlab::analysis {

double TaughtTrials::unitOf(const AnalyzedTrial& trial) const {
  return field && trial.scene.trained ? strengthOf(*trial.scene.trained, *field) : 1;
}

std::vector<TaughtTrials> taughtTrials(const Analysis& analysis) {
  std::map<std::pair<std::string, std::string>, std::array<bool, 2>> taught;  // by subject and session: by a field, by a rotation
  const auto taughtIn = [&](const AnalyzedTrial& t) -> std::array<bool, 2>& { return taught[{t.key.subject, t.key.session}]; };
  std::map<std::pair<std::string, bool>, TaughtTrials> people;
  const auto canTeach = [](const AnalyzedTrial& t) { return !t.catchTrial && std::isfinite(t.measures.maxPerpendicular); };
  for (const AnalyzedTrial& t : analysis.trials) {
    if (!canTeach(t)) continue;
    const bool by[2] = {t.scene.inField, t.scene.rotation != 0};
    for (const bool rotated : {false, true})
      if (by[rotated]) taughtIn(t)[rotated] = true, people[{t.key.subject, rotated}] = {t.key.subject, rotated, {}, {}};
  }
  for (auto& [name, person] : people) {
    for (const AnalyzedTrial& t : analysis.trials)
      if (t.key.subject == person.subject && canTeach(t) && (taughtIn(t)[person.rotated] || !taughtIn(t)[!person.rotated]))
        person.trials.push_back(&t);
    std::stable_sort(person.trials.begin(), person.trials.end(),
                     [](const AnalyzedTrial* a, const AnalyzedTrial* b) { return recordedBefore(a->key, b->key); });
    const auto first = std::find_if(person.trials.begin(), person.trials.end(), [](const AnalyzedTrial* t) { return t->scene.inField; });
    if (!person.rotated && first != person.trials.end()) person.field = (*first)->scene.trained;
  }
  std::vector<TaughtTrials> out;
  for (auto& [name, person] : people) out.push_back(std::move(person));
  return out;
}

Learning learningOf(const TaughtTrials& person) {
  constexpr std::size_t kFew = 5;  // an after-effect fades within some trials
  const auto& trials = person.trials;
  const auto inAny = [&](const AnalyzedTrial* t) { return person.rotated ? t->scene.rotation != 0 : t->scene.inField; };
  constexpr double kSame = 1e-9;  // of the field
  const auto perturbed = [&](const AnalyzedTrial* t) {
    return inAny(t) && (person.rotated || std::abs(person.strengthIn(*t) - 1) < kSame);
  };
  const auto deviation = [&](const AnalyzedTrial* t) {
    const bool otherwise = person.rotated ? t->scene.inField || t->scene.channel : t->scene.rotation != 0;
    return t->isLeftOut() || otherwise ? kNotMeasured : person.rotated ? t->measures.handAngle : t->measures.maxPerpendicular;
  };
  const auto share = [&](const AnalyzedTrial* t) {
    if (t->isLeftOut()) return kNotMeasured;
    if (!person.rotated) return t->measures.adaptation * person.unitOf(*t);
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
    return [&, inTraining](const AnalyzedTrial* t) {
      return !t->scene.channel && (inTraining ? perturbed(t) : !inAny(t)) ? deviation(t) : kNotMeasured;
    };
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
