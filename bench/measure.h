#pragma once
#include "bench/contender.h"

namespace reachlab::bench {

/// Largest differences from a reference in the states and in the positions [m].
struct Deviation {
  double state = 0, position = 0;
};

/// One row of the bench: a contender, its error against the reference, and its computation time.
struct Row {
  std::string scene, method, form;
  double step = 0, tolerance = 0;
  Deviation error;               // NaN if it did not reach the end
  double nsPerMs = 0;            // processor time per simulated millisecond, median of the rounds
  double nsLow = 0, nsHigh = 0;  // quarter and three-quarter points of the rounds
  std::uint64_t steps = 0, rhsEvaluations = 0, worstTick = 0;
  std::uint64_t bits = 0;  // a hash of all states: two programs that compute the same bits have the same
  std::string failure;     // why it did not reach the end; empty if it did
};

struct Effort {
  int rounds = 7;                 // timed repetitions, interleaved over the contenders
  double secondsPerRound = 2e-3;  // a round repeats the reach until it has taken this long
};

/// Measures the errors at 100 Hz, then the processor time of this thread. The contenders of a scene take turns, round after round, so that
/// other work of the machine slows all of them.
std::vector<Row> measure(const BenchScene& scene, const Reference& reference, const std::vector<Contender>& contenders,
                         const Effort& effort);

/// Largest difference of a trajectory from the reference. NaN where the trajectory holds NaN or ended early.
Deviation computeError(const Trajectory& trajectory, const Reference& reference);

}  // namespace reachlab::bench
