#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/steps.h"

namespace reachlab::analysis {

EpsilonTable makeEpsilonTable(std::span<const AnalyzedTrial> trials, std::size_t criteria, bool object) {
  EpsilonTable table;
  std::vector<double> squares(criteria, 0.0);
  std::map<std::string, std::pair<std::vector<double>, double>> people;
  double count = 0;
  for (const AnalyzedTrial& trial : trials) {
    if (!trial.used() || trial.paperError.empty()) continue;
    auto& [own, n] = people[trial.key.subject];
    own.resize(criteria);
    for (std::size_t c = 0; c < criteria; ++c) {
      const double e = trial.paperError[c + (object ? criteria : 0)];
      squares[c] += e * e;
      own[c] += e * e;
    }
    n += 1;
    count += 1;
  }
  if (count == 0) return table;
  std::vector<std::vector<double>> epsilon(criteria);  // [criterion][person]
  for (const auto& [subject, own] : people)
    for (std::size_t c = 0; c < criteria; ++c) epsilon[c].push_back(std::sqrt(own.first[c] / own.second));
  for (std::size_t c = 0; c < criteria; ++c) table.push_back({c, std::sqrt(squares[c] / count), averageOf(epsilon[c]), {}, 0, {}, false});
  std::stable_sort(table.begin(), table.end(), [](const EpsilonPlace& a, const EpsilonPlace& b) { return a.epsilon < b.epsilon; });
  for (EpsilonPlace& place : table) {
    if (people.size() < 2) {
      place.difference = place.epsilon - table.front().epsilon;
      continue;
    }
    const std::vector<double> differences = subtract(epsilon[place.criterion], epsilon[table.front().criterion]);
    place.interval = computeMeanInterval(epsilon[place.criterion]);
    place.interval->low = std::max(0.0, place.interval->low);  // no epsilon is negative
    place.difference = computeTTest(differences).mean;
    if (&place == &table.front()) continue;
    place.differenceInterval = computeMeanInterval(differences, 1 - 0.05 / std::max(1.0, static_cast<double>(criteria) - 1));
    place.apart = place.differenceInterval->low > 0 || place.differenceInterval->high < 0;
  }
  return table;
}

}  // namespace reachlab::analysis
