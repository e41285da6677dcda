#include "analysis/recovery.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include "analysis/tables.h"
#include "base/math/seeded.h"
#include "analysis/table_columns.h"
#include "base/table_text.h"

namespace reachlab::analysis {
namespace {

/// Draws that are the same on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t state) : state_(state) {}
  double fraction() { return seededFraction(state_, count_++); }
  std::size_t below(std::size_t n) { return std::min(n - 1, static_cast<std::size_t>(fraction() * static_cast<double>(n))); }

 private:
  std::uint64_t state_, count_ = 0;
};

/// A person's trials as they would look if they followed `shape`: each recorded trial's own onset, duration and amplitude, and the scatter of
/// another one drawn at random, turned over or not.
std::vector<FitWindow> simulatePerson(const Analysis& analysis, const PersonResult& person, const ProfileFamily& family,
                                      const ShapeChoice& choice, const CandidateFit& asFitted, Draws& draws) {
  std::vector<FitWindow> windows;
  Profile profile;
  const PersonTemplate& own = person.fit.own;
  std::size_t place = 0;
  for (std::size_t i = person.firstTrial; place < person.trials; ++i) {
    const AnalyzedTrial& trial = analysis.trials[i];
    if (!trial.used() || trial.window.size == 0) continue;
    FitWindow window;
    window.rate = trial.windowRate;
    window.begin = trial.windowBegin;
    window.velocity.resize(trial.window.size);
    window.weight.assign(window.velocity.size(), 1.0);
    const MovementFit& fit = asFitted.trials[place];
    const MovementFit& laid = own.place[place];
    const std::vector<float>& apart = own.apart[draws.below(own.apart.size())];
    const double sign = draws.fraction() < 0.5 ? -1 : 1;
    const bool possible = fit.found && family.at(choice.law == TimeLaw::OnePlan ? choice.plan : fit.duration, profile);
    for (std::size_t k = 0; k < window.velocity.size(); ++k) {
      const double t = window.begin + static_cast<double>(k) / window.rate;
      if (possible) window.velocity[k] = fit.amplitude * profile.at((t - fit.onset) / fit.duration);
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

  const auto candidateOf = [&](std::size_t condition, std::size_t truth) {
    const auto& all = analysis.results[condition].candidates.candidates;
    std::size_t k = 0;
    while (all[k].criteria != analysis.common[truth]) ++k;
    return k;
  };
  const auto nameOne = [&](std::size_t truth, int number) {
    std::vector<PersonScores> scores;
    std::map<std::string, std::size_t> index;
    Draws draws(seededBits(seededBits(seed, truth), static_cast<std::uint64_t>(number)));
    for (const PersonResult* person : people) {
      const CandidateSet& set = analysis.results[person->condition].candidates;
      const std::size_t k = candidateOf(person->condition, truth);
      const CandidateFit& fit = person->fit.candidates[k];
      std::vector<FitWindow> windows =
          simulatePerson(analysis, *person, *set.candidates[k].families[fit.choice.family], fit.choice, fit, draws);
      std::vector<double> durations;
      for (const MovementFit& laid : person->fit.own.place) durations.push_back(laid.duration);
      PersonResult simulated;
      simulated.subject = person->subject;
      simulated.condition = person->condition;
      simulated.fitted = true;
      simulated.fit = fitPerson(windows, durations, set);
      const PersonScores own = scoresOf(simulated);
      ConditionScores condition = own.conditions.front();
      ConditionScores shared = condition;
      shared.score.clear();
      shared.r2.clear();
      for (std::size_t c = 0; c < truths; ++c) {
        const std::size_t at = candidateOf(person->condition, c);
        shared.score.push_back(condition.score[at]);
        shared.r2.push_back(condition.r2[at]);
      }
      const auto [place, fresh] = index.try_emplace(person->subject, scores.size());
      if (fresh) scores.push_back({person->subject, {}});
      scores[place->second].conditions.push_back(std::move(shared));
    }
    return concludePeople(scores, truths, truths - 1).follows.value_or(truths);
  };

  const std::size_t jobs = truths * static_cast<std::size_t>(studies);
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t job; (job = next++) < jobs;) {
      const std::size_t truth = job % truths, named = nameOne(truth, static_cast<int>(job / truths));
      const std::lock_guard lock(mutex);
      ++out.counts[truth][named];
      ++done;
      if (progress) progress(done, jobs);
    }
  };
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::jthread> pool;
  for (unsigned t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  pool.clear();
  return out;
}

std::string recoveryTable(const TruthRecovery& recovery) {
  TableText table(',', "");
  for (const record::ColumnMeaning& column : tableColumns("recovery.csv")) table.cell(column.column);
  table.endRow();
  for (std::size_t t = 0; t < recovery.counts.size(); ++t)
    for (std::size_t n = 0; n < recovery.counts[t].size(); ++n) {
      table.cell(nameOfCandidate(recovery.candidates[t]))
          .cell(n < recovery.candidates.size() ? nameOfCandidate(recovery.candidates[n]) : "undecided");
      table.whole(static_cast<long long>(recovery.counts[t][n])).endRow();
    }
  return table.text();
}

}  // namespace reachlab::analysis
