#include "analysis/taught_trials.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "analysis/measures/deviation_and_adaptation.h"

namespace reachlab::analysis {

double TaughtTrials::unitOf(const AnalyzedTrial& trial) const {
  return field && trial.scene.trained ? strengthOf(*trial.scene.trained, *field) : 1;
}

std::vector<TaughtTrials> taughtTrials(const Analysis& analysis) {
  using Session = std::pair<std::string, std::string>;
  std::map<std::string, TaughtTrials> people[2];  // by subject: taught by a field, by a rotation
  std::set<Session> sessions[2];                  // in which they were taught by it
  const auto canTeach = [](const AnalyzedTrial& t) { return !t.catchTrial && std::isfinite(t.measures.maxPerpendicular); };
  for (const AnalyzedTrial& t : analysis.trials)
    for (const bool rotated : {false, true})
      if (canTeach(t) && (rotated ? t.scene.rotation != 0 : t.scene.inField)) {
        people[rotated][t.key.subject].rotated = rotated;
        sessions[rotated].emplace(t.key.subject, t.key.session);
      }
  for (const AnalyzedTrial& t : analysis.trials)
    for (const bool rotated : {false, true}) {
      const auto person = people[rotated].find(t.key.subject);
      const Session session{t.key.subject, t.key.session};
      if (person != people[rotated].end() && canTeach(t) && (sessions[rotated].contains(session) || !sessions[!rotated].contains(session)))
        person->second.trials.push_back(&t);
    }
  std::vector<TaughtTrials> out;
  for (auto& taught : people)
    for (auto& [subject, person] : taught) {
      person.subject = subject;
      std::stable_sort(person.trials.begin(), person.trials.end(),
                       [](const AnalyzedTrial* a, const AnalyzedTrial* b) { return recordedBefore(a->key, b->key); });
      const auto first = std::find_if(person.trials.begin(), person.trials.end(), [](const AnalyzedTrial* t) { return t->scene.inField; });
      if (!person.rotated) person.field = (*first)->scene.trained;
      out.push_back(std::move(person));
    }
  std::stable_sort(out.begin(), out.end(), [](const TaughtTrials& a, const TaughtTrials& b) { return a.subject < b.subject; });
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
