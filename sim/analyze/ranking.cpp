#include "sim/analyze/ranking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace reachlab::analyze {
namespace {

using Groups = std::vector<std::vector<const TrialErrors*>>;

Groups bySubject(std::span<const TrialErrors> trials) {
  std::map<std::string, std::vector<const TrialErrors*>> groups;
  for (const TrialErrors& trial : trials) groups[trial.subject].push_back(&trial);
  Groups out;
  for (auto& [subject, group] : groups) out.push_back(std::move(group));
  return out;
}

struct Sum {
  std::vector<double> squares;
  double samples = 0;
  explicit Sum(std::size_t criteria) : squares(criteria, 0.0) {}
  void add(const TrialErrors& trial) {
    for (std::size_t c = 0; c < squares.size(); ++c) squares[c] += trial.squares[c];
    samples += trial.samples;
  }
  double epsilon(std::size_t criterion) const { return std::sqrt(squares[criterion] / samples); }
};

Ranking rank(std::span<const TrialErrors> trials, const RankingOptions& options, bool drawSubjects) {
  Ranking ranking;
  const Groups groups = bySubject(trials);
  ranking.trials = trials.size();
  ranking.subjects = groups.size();
  if (trials.empty()) return ranking;
  const std::size_t criteria = trials.front().squares.size();

  Sum whole(criteria);
  for (const TrialErrors& trial : trials) whole.add(trial);
  std::vector<std::size_t> order(criteria);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return whole.epsilon(a) < whole.epsilon(b); });
  const std::size_t first = order.empty() ? 0 : order.front();

  std::vector<std::vector<double>> epsilons(criteria), differences(criteria);
  std::vector<double> wins(criteria, 0.0);
  std::mt19937_64 random(options.seed);
  for (int r = 0; r < options.resamples; ++r) {
    Sum sum(criteria);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const auto& group = groups[drawSubjects ? drawIndex(random, groups.size()) : g];
      for (std::size_t i = 0; i < group.size(); ++i) sum.add(*group[drawIndex(random, group.size())]);
    }
    std::size_t best = first;
    for (const std::size_t c : order) {
      epsilons[c].push_back(sum.epsilon(c));
      differences[c].push_back(sum.epsilon(c) - sum.epsilon(first));
      if (sum.epsilon(c) < sum.epsilon(best)) best = c;
    }
    wins[best] += 1;
  }

  for (const std::size_t c : order) {
    RankedCriterion place;
    place.criterion = c;
    place.epsilon = whole.epsilon(c);
    place.interval = centralInterval(epsilons[c], options.level);
    place.difference = whole.epsilon(c) - whole.epsilon(first);
    place.differenceInterval = centralInterval(differences[c], options.level);
    place.firstShare = wins[c] / std::max(1, options.resamples);
    // One trial resampled is itself: an interval without width says nothing.
    place.apartFromFirst = c != first && trials.size() > 1 && place.differenceInterval.low > 0;
    ranking.places.push_back(place);
  }
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      std::vector<double> difference = epsilons[order[j]];
      for (std::size_t r = 0; r < difference.size(); ++r) difference[r] -= epsilons[order[i]][r];
      if (trials.size() < 2 || !(centralInterval(std::move(difference), options.level).low > 0)) ranking.ties.emplace_back(i, j);
    }
  return ranking;
}

}  // namespace

double computeRmsError(std::span<const double> predicted, std::span<const double> measured) {
  const std::size_t n = std::min(predicted.size(), measured.size());
  if (n == 0) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += (predicted[i] - measured[i]) * (predicted[i] - measured[i]);
  return std::sqrt(sum / static_cast<double>(n));
}

bool Ranking::decided() const {
  return places.size() > 1 && std::all_of(places.begin() + 1, places.end(), [](const RankedCriterion& p) { return p.apartFromFirst; });
}

Ranking rankOverTrials(std::span<const TrialErrors> trials, const RankingOptions& options) { return rank(trials, options, false); }

std::optional<Ranking> rankOverSubjects(std::span<const TrialErrors> trials, const RankingOptions& options) {
  if (bySubject(trials).size() < 2) return std::nullopt;
  return rank(trials, options, true);
}

}  // namespace reachlab::analyze
