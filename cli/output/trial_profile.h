#pragma once
#include <vector>

#include "analysis/figure/figure.h"
#include "sim/record/log/run_log.h"

namespace reachlab::cli {

/// A recorded trial at its samples, from its preparation to its end.
struct ShownTrial {
  std::vector<double> time;        // [s] since onset, or since the preparation where there is no onset
  std::vector<double> handSpeed;   // [m/s]
  std::vector<double> firstSpeed;  // [m/s] of the driven mass
  std::vector<double> lastSpeed;   // [m/s] of the last mass
  std::vector<double> force;       // [N] magnitude of the coupling's
  bool sinceOnset = true;
};

/// Reads the trial's rows. Throws FaultError if the log has changed meanwhile.
ShownTrial profileOf(const record::RunLog& log, const record::RecordedTrial& trial);
/// Speeds with the task's T and T ± dT, and the coupling force, over time.
figure::Figure drawTrial(const record::RunLog& log, const record::RecordedTrial& trial);

}  // namespace reachlab::cli
