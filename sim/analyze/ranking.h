#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/analyze/statistics.h"

/// Which criterion is nearest to the measured profiles, and how sure that is. Pure functions; any thread.
namespace reachlab::analyze {

/// The paper's error of one series (sec. 5): sqrt(1/N sum (v_pred - v_exp)^2) over all N samples.   [unit of the profiles]
/// Both of the same length; NaN for none.
double computeRmsError(std::span<const double> predicted, std::span<const double> measured);

/// What one trial contributes: for each criterion the sum of its squared errors.
struct TrialErrors {
  std::string subject;
  std::vector<double> squares;  // one a criterion
  double samples = 0;
};

struct RankingOptions {
  int resamples = 2000;
  std::uint64_t seed = 1;
  double level = 0.95;
};

/// One criterion's place. Differences are to the criterion that ranks first, from the same resamples (paired).
struct RankedCriterion {
  std::size_t criterion = 0;  // index into TrialErrors::squares
  double epsilon = 0;         // paper's formula over all samples of the accepted trials
  Interval interval;          // of epsilon, bootstrap percentiles
  double difference = 0;      // epsilon - epsilon of the first
  Interval differenceInterval;
  double firstShare = 0;        // of resamples in which it was first
  bool apartFromFirst = false;  // the difference's interval excludes 0
};

struct Ranking {
  std::vector<RankedCriterion> places;  // best first
  /// Pairs of places (better first) that cannot be told apart: the interval of their difference includes 0.
  std::vector<std::pair<std::size_t, std::size_t>> ties;
  std::size_t trials = 0, subjects = 0;
  /// The first place is held alone: every other criterion's difference excludes 0.
  bool decided() const;
};

/// Bootstrap over trials: trials are drawn with replacement within each subject. Empty for no trials; with one trial the intervals
/// have no width and nothing is told apart.
Ranking rankOverTrials(std::span<const TrialErrors> trials, const RankingOptions& options);
/// Bootstrap over subjects: subjects are drawn with replacement, then trials within each drawn one. nullopt for fewer than two subjects.
std::optional<Ranking> rankOverSubjects(std::span<const TrialErrors> trials, const RankingOptions& options);

}  // namespace reachlab::analyze
