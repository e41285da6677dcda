#include "analysis/conclusions/conclusion.h"

#include <algorithm>
#include <cmath>

#include "analysis/conclusions/model_selection.h"

namespace reachlab::analysis {
namespace {

/// Y of each candidate for one person: mean over conditions of the mean over trials.
std::vector<double> scoresOf(const PersonScores& person, std::size_t candidates) {
  std::vector<double> out(candidates, 0.0);
  for (const ConditionScores& condition : person.conditions)
    for (std::size_t c = 0; c < candidates; ++c) out[c] += averageOf(condition.score[c]) / static_cast<double>(person.conditions.size());
  return out;
}

TTest compareInPerson(const PersonScores& person, std::size_t a, std::size_t b) {
  std::vector<TTest> tests;
  for (const ConditionScores& condition : person.conditions)
    tests.push_back(computeSerialTTest(subtract(condition.score[a], condition.score[b])));
  return combineTTests(tests);
}

/// One score less another of each person. `table` [person][candidate].
std::vector<double> differencesIn(const std::vector<std::vector<double>>& table, std::size_t a, std::size_t b) {
  std::vector<double> d;
  for (const auto& row : table) d.push_back(row[a] - row[b]);
  return d;
}

std::size_t leastOf(const std::vector<double>& scores) {
  return static_cast<std::size_t>(std::min_element(scores.begin(), scores.end()) - scores.begin());
}

/// The best candidate against every other; `compare(a, b)` tests the score of a less that of b.
template <typename Compare>
void compareAll(Conclusion& out, std::size_t reference, Compare&& compare) {
  const std::size_t candidates = out.score.size(), best = leastOf(out.score);
  out.best = best;
  out.referenceFirst = best == reference;
  out.p = 0;
  out.against.assign(candidates, {});
  for (std::size_t c = 0; c < candidates; ++c) {
    if (c == best) continue;
    out.against[c] = compare(c, best);
    const TTest& test = out.against[c];
    if (!out.rival || test.p > out.p || (test.p == out.p && test.mean < out.against[*out.rival].mean)) out.p = test.p, out.rival = c;
  }
  out.referenceP = out.referenceFirst ? 1 : out.against[reference].p;
  std::vector<double> p, difference;
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < candidates; ++a)
    for (std::size_t b = a + 1; b < candidates; ++b) {
      const TTest test = compare(a, b);
      pairs.emplace_back(a, b), p.push_back(test.p), difference.push_back(std::abs(test.mean));
    }
  const std::vector<double> adjusted = adjustByHolm(p);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!(adjusted[i] < out.level && difference[i] >= kLeastDifference)) out.notToldApart.push_back(pairs[i]);
}

bool isToldFromAll(const Conclusion& c) {
  for (std::size_t k = 0; k < c.against.size(); ++k)
    if (k != *c.best && !c.told(k)) return false;
  return true;
}
bool referenceStands(const Conclusion& c, std::size_t reference) { return c.referenceFirst || !c.told(reference); }
bool describesPoorly(const Conclusion& c) {
  const bool misfits = c.misfit.p < kMisfitLevel && c.misfit.mean >= kLeastMisfit;
  const bool systematic = c.systematic.p() < kSystematicLevel && c.systematic.share >= kLeastSystematic &&
                          c.systematic.share * (1 - c.r2) >= kLeastSystematicSpeed * kLeastSystematicSpeed;
  const bool mixed = c.mixtureP < kMixtureLevel && c.mixture.mean >= kLeastMixture;
  constexpr double kRounding = 1e-9;  // a mean of ones is not always one
  return misfits || systematic || mixed || 1 - c.r2 > kMostUnexplained * (1 - c.ceiling) + kRounding;
}

/// What keeps several people from one conclusion.
struct Disagreement {
  bool few = false, differ = false, rare = false;  // too few people; some are decided otherwise; the best is not the most frequent
};
void decide(Conclusion& out, std::size_t reference, const Disagreement& people) {
  if (out.score.size() < 3) out.reason = Obstacle::NothingToCompare;
  else if (people.few) out.reason = Obstacle::TooFewSubjects;
  else if (people.differ) out.reason = Obstacle::SubjectsDiffer;
  else if (referenceStands(out, reference)) out.reason = Obstacle::Reference;
  else if (!isToldFromAll(out)) out.reason = Obstacle::NotToldApart;
  else if (people.rare) out.reason = Obstacle::SubjectsDiffer;
  else if (!out.atEdge.empty()) out.reason = Obstacle::MassAtEdge;
  else if (describesPoorly(out)) out.reason = Obstacle::Poor;
  else out.reason = Obstacle::None, out.follows = out.best;
}

/// One person with the scores of candidates at the edge of the range of masses replaced by those outside it.
PersonScores outsideTheRange(const PersonScores& person) {
  PersonScores out = person;
  for (ConditionScores& condition : out.conditions)
    for (std::size_t k = 0; k < condition.beyond.size(); ++k)
      if (!condition.beyond[k].empty() && averageOf(condition.beyond[k]) < averageOf(condition.score[k]))
        condition.score[k] = condition.beyond[k];
  return out;
}
bool isAtEdge(const PersonScores& person, std::size_t candidate) {
  return std::any_of(person.conditions.begin(), person.conditions.end(),
                     [&](const ConditionScores& c) { return candidate < c.beyond.size() && !c.beyond[candidate].empty(); });
}
/// A candidate at the edge blocks a decision if it is the best, or if a mass outside the range is not told from the best. `compare(k, best)`
/// tests the scores outside the range.
template <typename Compare>
void findMassesAtEdge(Conclusion& out, const std::vector<PersonScores>& people, const std::vector<HeavyLimit>& limits, Compare&& compare) {
  for (std::size_t k = 0; k < out.score.size(); ++k) {
    if (std::none_of(people.begin(), people.end(), [&](const PersonScores& p) { return isAtEdge(p, k); })) continue;
    // The best is what this candidate becomes for a hand without a limit of mass: heavier hands come near it, and are not nearer.
    if (std::any_of(limits.begin(), limits.end(), [&](const HeavyLimit& l) { return l.candidate == k && l.becomes == *out.best; }))
      continue;
    const TTest test = k == *out.best ? TTest{} : compare(k, *out.best);
    if (k == *out.best || !(test.p < out.level && test.mean >= kLeastDifference)) out.atEdge.push_back(k);
  }
}

TTest misfitInPerson(const PersonScores& person, std::size_t best) {
  std::vector<TTest> tests;
  for (const ConditionScores& c : person.conditions)
    if (!c.own.empty()) tests.push_back(computeSerialTTest(subtract(c.score[best], c.own)));
  return tests.empty() ? TTest{} : combineTTests(tests);
}
/// Of each condition of each person.
SystematicRest systematicRest(const std::vector<PersonScores>& people, std::size_t best) {
  std::vector<SystematicRest> rests;
  for (const PersonScores& person : people)
    for (const ConditionScores& c : person.conditions)
      if (!c.systematic.empty()) rests.push_back(c.systematic[best]);
  return meanOf(rests);
}
/// `towards(k)` tests how far the movements go from the best towards candidate k.
template <typename Towards>
void findMixture(Conclusion& out, Towards&& towards) {
  for (std::size_t k = 0; k < out.score.size(); ++k) {
    if (k == *out.best) continue;
    const TTest test = towards(k);
    const double p = std::min(1.0, (test.t > 0 ? test.p / 2 : 1 - test.p / 2) * static_cast<double>(out.score.size() - 1));
    if (!out.mixedWith || p < out.mixtureP) out.mixedWith = k, out.mixture = test, out.mixtureP = p;
  }
}
/// Of each condition; empty where one was not tested.
std::vector<TTest> towardsInPerson(const PersonScores& person, std::size_t best, std::size_t other) {
  std::vector<TTest> tests;
  for (const ConditionScores& c : person.conditions) {
    if (c.toward.empty() || c.toward[best].empty()) return {};
    tests.push_back(computeSerialTTest(c.toward[best][other]));
  }
  return tests;
}
double meanMisfit(const PersonScores& person, std::size_t best) {
  double sum = 0;
  for (const ConditionScores& c : person.conditions)
    if (!c.own.empty()) sum += averageOf(subtract(c.score[best], c.own)) / static_cast<double>(person.conditions.size());
  return sum;
}

}  // namespace

std::size_t PersonScores::trials() const {
  std::size_t n = 0;
  for (const ConditionScores& c : conditions) n += c.score.empty() ? 0 : c.score.front().size();
  return n;
}

std::string_view nameOf(Obstacle reason) {
  static constexpr std::string_view kNames[] = {
      "",     "too_few_trials",    "too_few_subjects", "reference", "not_told_apart", "subjects_differ", "mass_at_edge",
      "poor", "nothing_to_compare"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Obstacle::NothingToCompare) + 1);
  return kNames[static_cast<std::size_t>(reason)];
}

Conclusion concludePerson(const PersonScores& person, std::size_t candidates, std::size_t reference,
                          const std::vector<HeavyLimit>& limits) {
  Conclusion out;
  out.subjects = 1;
  out.subject = person.subject;
  out.trials = person.trials();
  if (person.conditions.empty()) return out;
  out.score = scoresOf(person, candidates);
  out.closest.assign(candidates, 0);
  ++out.closest[leastOf(out.score)];
  compareAll(out, reference, [&](std::size_t a, std::size_t b) { return compareInPerson(person, a, b); });
  for (const ConditionScores& c : person.conditions) {
    out.r2 += c.r2[*out.best] / static_cast<double>(person.conditions.size());
    out.ceiling += c.ceiling / static_cast<double>(person.conditions.size());
  }
  out.misfit = misfitInPerson(person, *out.best);
  out.systematic = systematicRest({person}, *out.best);
  findMixture(out, [&](std::size_t k) {
    const std::vector<TTest> tests = towardsInPerson(person, *out.best, k);
    return tests.empty() ? TTest{} : combineTTests(tests);
  });
  const PersonScores outside = outsideTheRange(person);
  findMassesAtEdge(out, {person}, limits, [&](std::size_t a, std::size_t b) { return compareInPerson(outside, a, b); });
  decide(out, reference, {});
  out.each = {out.follows};
  return out;
}

Conclusion concludePeople(const std::vector<PersonScores>& everyone, std::size_t candidates, std::size_t reference,
                          const std::vector<HeavyLimit>& limits) {
  std::vector<PersonScores> people;
  for (const PersonScores& person : everyone)
    if (!person.conditions.empty()) people.push_back(person);
  if (people.size() < 2) {
    Conclusion out = concludePerson(people.empty() ? PersonScores{} : people.front(), candidates, reference, limits);
    out.subjects = people.size();
    out.leftOut = everyone.size() - people.size();
    return out;
  }
  Conclusion out;
  out.overSubjects = true;
  out.level = kSubjectsLevel;
  out.subjects = people.size();
  out.leftOut = everyone.size() - people.size();
  std::vector<std::vector<double>> table, evidence;
  out.score.assign(candidates, 0.0);
  out.closest.assign(candidates, 0);
  for (const PersonScores& person : people) {
    table.push_back(scoresOf(person, candidates));
    ++out.closest[leastOf(table.back())];
    for (std::size_t c = 0; c < candidates; ++c) out.score[c] += table.back()[c] / static_cast<double>(people.size());
    std::vector<double> log(candidates, 0.0);
    for (const ConditionScores& condition : person.conditions)
      for (std::size_t c = 0; c < candidates; ++c)
        for (const double y : condition.score[c]) log[c] -= condition.effectiveSamples / 2 * y;
    evidence.push_back(std::move(log));
    out.trials += person.trials();
    out.each.push_back(concludePerson(person, candidates, reference, limits).follows);
  }
  compareAll(out, reference, [&](std::size_t a, std::size_t b) { return computeTTest(differencesIn(table, a, b)); });
  out.posterior = selectModel(evidence).protectedExceedance;
  if (people.size() >= kFewestForSignFlip && out.rival) out.signFlipP = computeSignFlipP(differencesIn(table, *out.rival, *out.best));
  for (const PersonScores& person : people)
    for (const ConditionScores& c : person.conditions) {
      const double share = 1.0 / static_cast<double>(people.size()) / static_cast<double>(person.conditions.size());
      out.r2 += share * c.r2[*out.best];
      out.ceiling += share * c.ceiling;
    }
  std::vector<double> misfits;
  for (const PersonScores& person : people)
    if (std::none_of(person.conditions.begin(), person.conditions.end(), [](const ConditionScores& c) { return c.own.empty(); }))
      misfits.push_back(meanMisfit(person, *out.best));
  out.misfit = computeTTest(misfits);
  out.systematic = systematicRest(people, *out.best);
  findMixture(out, [&](std::size_t k) {
    std::vector<double> shares;
    for (const PersonScores& person : people)
      if (const std::vector<TTest> tests = towardsInPerson(person, *out.best, k); !tests.empty())
        shares.push_back(combineTTests(tests).mean);
    return computeTTest(shares);
  });
  std::vector<std::vector<double>> outside;
  for (const PersonScores& person : people) outside.push_back(scoresOf(outsideTheRange(person), candidates));
  findMassesAtEdge(out, people, limits, [&](std::size_t a, std::size_t b) { return computeTTest(differencesIn(outside, a, b)); });
  bool differ = false;  // people who are decided for another than the best, or for different ones
  for (const auto& each : out.each)
    for (const auto& other : out.each) differ = differ || (each && other && *each != *other);
  for (const auto& each : out.each) differ = differ || (each && *each != *out.best);
  decide(out, reference, {people.size() < kFewestSubjects, differ, !(out.posterior[*out.best] >= kMinExceedance)});
  return out;
}

}  // namespace reachlab::analysis
