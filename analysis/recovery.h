#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// Studies whose people move otherwise than the fits assume.
struct OtherTruth {
  std::string_view name;
  std::size_t right = 0, wrong = 0, undecided = 0;  // studies
  std::size_t studies() const { return right + wrong + undecided; }
};

/// How often this very design names the truth. Simulated people follow a candidate. Their number, trials, durations and scatter are those
/// of the recorded people, and the same code judges both.
struct TruthRecovery {
  std::size_t trials = 0;  // recorded ones whose count, durations and scatter were taken
  int studies = 0;         // simulated for each truth
  std::uint64_t seed = 1;
  std::vector<std::vector<predict::Criterion>> candidates;  // truths, in this order; the reference is the last
  std::vector<std::vector<std::size_t>> counts;             // [truth][named], the last column undecided
  /// A candidate is right for "other-hand-masses" (a mass drawn from the range), "own-skew" (each person is ahead of the plan or behind it by up
  /// to 2 to 10 % of the duration) and "own-warp" (ahead in one half and behind in the other). Every name is wrong for "mean-of-two" (the mean of
  /// two candidates), "two-in-turn" (each trial by one of two candidates), "hand-snap" (a minimum snap of the hand, which ignores the object) and
  /// "two-submovements".
  std::vector<OtherTruth> others;
};

using RecoveryProgress = std::function<void(std::size_t done, std::size_t of)>;

/// `studies` for each truth, `seed` on: the same numbers whatever the number of threads. 0 threads: one per processor. The study must have
/// been made with AnalysisOptions::keepScatter. Empty counts where nothing could be fitted.
TruthRecovery recover(const Analysis& analysis, int studies, std::uint64_t seed, unsigned threads = 0,
                      const RecoveryProgress& progress = {});

/// recovery.csv: truth, named, count. Other truths are named right, wrong or undecided.
std::string recoveryTable(const TruthRecovery& recovery);

}  // namespace reachlab::analysis
