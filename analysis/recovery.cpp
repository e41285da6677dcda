#include "analysis/recovery.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <optional>
#include <thread>

#include "analysis/sheet.h"
#include "analysis/steps.h"
#include "base/math/minimum_jerk.h"
#include "base/math/seeded.h"
#include "base/system/worker_threads.h"

namespace reachlab::analysis {
namespace {

enum class Kind { Candidate, OtherMasses, OwnSkew, OwnWarp, MeanOfTwo, TwoInTurn, HandSnap, TwoSubmovements };
constexpr std::array<std::pair<Kind, std::string_view>, 7> kOthers{{{Kind::OtherMasses, "other-hand-masses"},
                                                                    {Kind::OwnSkew, "own-skew"},
                                                                    {Kind::OwnWarp, "own-warp"},
                                                                    {Kind::MeanOfTwo, "mean-of-two"},
                                                                    {Kind::TwoInTurn, "two-in-turn"},
                                                                    {Kind::HandSnap, "hand-snap"},
                                                                    {Kind::TwoSubmovements, "two-submovements"}}};
constexpr double kLeastWarp = 0.02, kWarpRange = 0.08;  // of the duration
bool followsCandidate(Kind kind) { return kind <= Kind::OwnWarp; }
bool needsTwo(Kind kind) { return kind == Kind::MeanOfTwo || kind == Kind::TwoInTurn; }

/// Draws that are the same on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t state) : state_(state) {}
  double fraction() { return seededFraction(state_, count_++); }
  std::size_t below(std::size_t n) { return std::min(n - 1, static_cast<std::size_t>(fraction() * static_cast<double>(n))); }

 private:
  std::uint64_t state_, count_ = 0;
};

/// How a person moves.
struct Mover {
  Kind kind = Kind::Candidate;
  std::size_t first = 0, second = 0;  // indices into Analysis::common, equal for one plan
  double warp = 0, waves = 1;         // s becomes s + warp sin(pi waves s) / waves
};

/// Hand velocities over the part of the movement that know no object, each for one person.
ProfileFamily::Sampler samplerOf(Kind kind, Draws& draws) {
  if (kind == Kind::HandSnap) return ProfileFamily::sameFor([](double s) { return 140 * std::pow(s * (1 - s), 3); });
  const double part = 0.55 + 0.2 * draws.fraction(), delay = 0.25 + 0.15 * draws.fraction(), length = 1 - delay;
  return ProfileFamily::sameFor([=](double s) {
    const auto bell = [&](double x) { return x > 0 && x < 1 ? minimumJerkRate(x) / length : 0; };
    return part * bell(s / length) + (1 - part) * bell((s - delay) / length);
  });
}

/// The velocity of the hand [m/s] at the instants of `window` when a trial that was fitted so is moved by `family`.
void addPlanned(FitWindow& window, const ProfileFamily& family, const ShapeChoice& choice, const MovementFit& fit, const Mover& mover,
                double share) {
  Profile profile;
  if (!fit.found || !family.at(choice.law == TimeLaw::OnePlan ? choice.plan : fit.duration, profile)) return;
  for (std::size_t k = 0; k < window.velocity.size(); ++k) {
    double s = (window.begin + static_cast<double>(k) / window.rate - fit.onset) / fit.duration, rate = 1;
    if (mover.warp != 0 && s > 0 && s < 1) {
      const double angle = std::numbers::pi * mover.waves * s;
      rate = 1 + mover.warp * std::numbers::pi * std::cos(angle);
      s += mover.warp * std::sin(angle) / mover.waves;
    }
    window.velocity[k] += share * fit.amplitude * rate * profile.at(s);
  }
}

/// A person's trials as they would look if they were moved so: each recorded trial's own onset, duration and amplitude, and the scatter of
/// another trial drawn at random, turned over or not. `planned(window, place)` adds the velocity of a trial.
template <typename Planned>
std::vector<FitWindow> simulatePerson(const Analysis& analysis, const PersonResult& person, Planned&& planned, Draws& draws) {
  std::vector<FitWindow> windows;
  const PersonTemplate& own = person.fit.own;
  std::size_t place = 0;
  for (const AnalyzedTrial* trial : fittedTrials(analysis, person)) {
    FitWindow window;
    window.rate = trial->windowRate;
    window.begin = trial->windowBegin;
    window.velocity.assign(trial->window.size, 0.0);
    window.weight.assign(window.velocity.size(), 1.0);
    const MovementFit& laid = own.place[place];
    const std::vector<float>& apart = own.apart[draws.below(own.apart.size())];
    const double sign = draws.fraction() < 0.5 ? -1 : 1;
    planned(window, place);
    for (std::size_t k = 0; k < window.velocity.size(); ++k) {
      const double t = window.begin + static_cast<double>(k) / window.rate;
      const double x = ((t - laid.onset) / laid.duration - own.mean.first) / own.mean.step;
      if (!(x >= 0) || x + 1 >= static_cast<double>(apart.size())) continue;
      const auto cell = static_cast<std::size_t>(x);
      const double part = x - static_cast<double>(cell);
      window.velocity[k] += sign * ((1 - part) * static_cast<double>(apart[cell]) + part * static_cast<double>(apart[cell + 1]));
    }
    windows.push_back(std::move(window));
    ++place;
  }
  return windows;
}

/// Studies whose people move by a known rule, each judged as the recorded study is.
class SimulatedStudies {
 public:
  SimulatedStudies(const Analysis& analysis, std::vector<const PersonResult*> people, std::uint64_t seed)
      : analysis_(analysis), people_(std::move(people)), seed_(seed) {
    for (std::size_t truth = 0; truth < truths(); ++truth) {
      if (analysis.common[truth].empty()) continue;
      named_.push_back(truth);
      const auto hasMass = [&](const PersonResult* p) { return static_cast<bool>(candidateOf(*p, truth).familyOf); };
      if (std::all_of(people_.begin(), people_.end(), hasMass)) withMass_.push_back(truth);
    }
  }
  /// There are candidates enough for this kind.
  bool has(Kind kind) const { return candidatesFor(kind).size() > (needsTwo(kind) ? 1 : 0); }
  /// The candidate that is concluded where everybody follows `truth`; their count if nothing is.
  std::size_t nameOne(std::size_t truth, int number) const {
    Draws draws = drawsOf(truth, number);
    return judge({Kind::Candidate, truth, truth}, draws);
  }
  /// True if the right candidate is concluded. nullopt: undecided.
  std::optional<bool> judgeOther(Kind kind, int number) const {
    Draws draws = drawsOf(truths() + static_cast<std::size_t>(kind), number);
    const std::vector<std::size_t>& from = candidatesFor(kind);
    const std::size_t drawn = draws.below(from.size());
    Mover mover{kind, from[drawn], from[drawn]};
    if (needsTwo(kind)) mover.second = from[(drawn + 1 + draws.below(from.size() - 1)) % from.size()];
    const std::size_t follows = judge(mover, draws);
    if (follows == truths()) return std::nullopt;
    return followsCandidate(kind) && follows == mover.first;
  }

 private:
  struct Plan {
    const CandidateFit* fit;
    std::shared_ptr<const ProfileFamily> family;
  };

  std::size_t truths() const { return analysis_.common.size(); }
  const std::vector<std::size_t>& candidatesFor(Kind kind) const { return kind == Kind::OtherMasses ? withMass_ : named_; }
  const CandidateSet& setOf(const PersonResult& person) const { return analysis_.results[person.condition].candidates; }
  std::size_t indexOf(const PersonResult& person, std::size_t truth) const {
    std::size_t k = 0;
    while (setOf(person).candidates[k].criteria != analysis_.common[truth]) ++k;
    return k;
  }
  const Candidate& candidateOf(const PersonResult& person, std::size_t truth) const {
    return setOf(person).candidates[indexOf(person, truth)];
  }
  Draws drawsOf(std::size_t stream, int number) const {
    return Draws(seededBits(seededBits(seed_, stream), static_cast<std::uint64_t>(number)));
  }

  Plan planOf(const PersonResult& person, Kind kind, std::size_t truth, Draws& draws) const {
    const Candidate& candidate = candidateOf(person, truth);
    const CandidateFit& fit = person.fit.candidates[indexOf(person, truth)];
    if (kind != Kind::OtherMasses || !candidate.familyOf) return {&fit, fit.family};
    return {&fit, candidate.familyOf(candidate.masses.front() + draws.fraction() * (candidate.masses.back() - candidate.masses.front()))};
  }

  /// The person's trials as `mover` moves them, fitted again.
  PersonResult simulate(const PersonResult& person, Mover mover, Draws& draws) const {
    if (mover.kind == Kind::OwnSkew || mover.kind == Kind::OwnWarp) {
      mover.warp = (kLeastWarp + kWarpRange * draws.fraction()) * (draws.fraction() < 0.5 ? -1 : 1);
      mover.waves = mover.kind == Kind::OwnSkew ? 1 : 2;
    }
    Plan first = planOf(person, mover.kind, mover.first, draws);
    if (mover.kind == Kind::HandSnap || mover.kind == Kind::TwoSubmovements) {  // where and how long the reference moves
      const double rate = fittedTrials(analysis_, person).front()->windowRate;
      first.fit = &person.fit.candidates.back();
      first.family = std::make_shared<ProfileFamily>(samplerOf(mover.kind, draws), RecordingFilter(analysis_.options.measure.cutoff, rate),
                                                     first.family->grid());
    }
    const Plan second = mover.second == mover.first ? first : planOf(person, mover.kind, mover.second, draws);
    const auto add = [&](FitWindow& window, const Plan& plan, std::size_t place, double share) {
      addPlanned(window, *plan.family, plan.fit->choice, plan.fit->trials[place], mover, share);
    };
    const auto planned = [&](FitWindow& window, std::size_t place) {
      if (mover.kind == Kind::TwoInTurn) return add(window, draws.fraction() < 0.5 ? second : first, place, 1);
      add(window, first, place, 0.5);
      add(window, second, place, 0.5);
    };
    std::vector<FitWindow> windows = simulatePerson(analysis_, person, planned, draws);
    std::vector<double> durations;
    for (const MovementFit& laid : person.fit.own.place) durations.push_back(laid.duration);
    PersonResult simulated;
    simulated.subject = person.subject;
    simulated.condition = person.condition;
    simulated.fitted = true;
    simulated.fit = fitPerson(windows, durations, setOf(person));
    return simulated;
  }

  std::size_t judge(const Mover& mover, Draws& draws) const {
    std::vector<PersonScores> scores;
    std::map<std::string, std::size_t> index;
    for (const PersonResult* person : people_) {
      const PersonResult simulated = simulate(*person, mover, draws);
      const auto [place, fresh] = index.try_emplace(person->subject, scores.size());
      if (fresh) scores.push_back({person->subject, {}});
      scores[place->second].conditions.push_back(scoresOf(simulated, setOf(*person), analysis_.common));
    }
    return concludePeople(scores, truths(), truths() - 1, heavyLimits(analysis_.common)).follows.value_or(truths());
  }

  const Analysis& analysis_;
  std::vector<const PersonResult*> people_;
  std::uint64_t seed_;
  std::vector<std::size_t> named_, withMass_;  // truths; the second: those whose hand has a mass
};

}  // namespace

TruthRecovery recover(const Analysis& analysis, int studies, std::uint64_t seed, unsigned threads, const RecoveryProgress& progress) {
  TruthRecovery out;
  out.studies = studies;
  out.seed = seed;
  out.candidates = analysis.common;
  std::vector<const PersonResult*> people;
  for (const PersonResult& p : analysis.people)
    if (p.fitted && std::find(analysis.together.begin(), analysis.together.end(), p.condition) != analysis.together.end())
      people.push_back(&p), out.trials += p.trials;
  const std::size_t truths = analysis.common.size();
  out.counts.assign(truths, std::vector<std::size_t>(truths + 1, 0));
  if (people.empty() || studies < 1) return out;

  const SimulatedStudies simulated(analysis, people, seed);
  std::vector<Kind> kinds;  // parallel to out.others
  for (const auto& [kind, name] : kOthers)
    if (simulated.has(kind)) kinds.push_back(kind), out.others.push_back({name});

  const std::size_t inside = truths * static_cast<std::size_t>(studies);
  const std::size_t jobs = inside + out.others.size() * static_cast<std::size_t>(studies);
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  if (threads == 0) threads = std::thread::hardware_concurrency();
  runOnThreads(threads, [&](const std::atomic<bool>& ended) {
    for (std::size_t job; (job = next++) < jobs && !ended;) {
      std::size_t truth = job % truths, follows = truths;
      std::optional<bool> right;
      if (job < inside) follows = simulated.nameOne(truth, static_cast<int>(job / truths));
      else {
        truth = (job - inside) % kinds.size();
        right = simulated.judgeOther(kinds[truth], static_cast<int>((job - inside) / kinds.size()));
      }
      const std::lock_guard lock(mutex);
      if (job < inside) ++out.counts[truth][follows];
      else if (!right) ++out.others[truth].undecided;
      else ++(*right ? out.others[truth].right : out.others[truth].wrong);
      ++done;
      if (progress) progress(done, jobs);
    }
  });
  return out;
}

namespace {

void recoveryRows(const TruthRecovery& recovery, Sheet& table) {
  for (std::size_t t = 0; t < recovery.counts.size(); ++t)
    for (std::size_t n = 0; n < recovery.counts[t].size(); ++n)
      table.row(nameOfCandidate(recovery.candidates[t]),
                n < recovery.candidates.size() ? nameOfCandidate(recovery.candidates[n]) : "undecided", recovery.counts[t][n]);
  for (const OtherTruth& other : recovery.others)
    for (const auto& [named, count] : {std::pair("right", other.right), {"wrong", other.wrong}, {"undecided", other.undecided}})
      table.row(other.name, named, count);
}

}  // namespace

std::string recoveryTable(const TruthRecovery& recovery) { return sheetText("recovery.csv", recovery, recoveryRows); }

}  // namespace reachlab::analysis
