#pragma once
#include <span>
#include <vector>

#include "analysis/measures/measures.h"
#include "analysis/study/columns.h"
#include "sim/record/log/run_log.h"

namespace reachlab::study {

/// The values of one trial that are entered into the table.
struct MeasuredTrial {
  record::RecordedTrial recorded;
  analysis::TrialMeasures measures;                // with Needs::samples
  std::vector<double> epsilonHand, epsilonObject;  // [m/s] one of each of criteriaOf, NaN where there is none
  std::vector<double>
      score;  // the same, then the reference's, effective samples of a trial, and how much poorer the best is than the subject's own mean
  std::vector<float> profile;  // 101 points of the hand's velocity, then of the last mass's; empty: none
};

/// Writes outcome, reason and the measures behind the identity columns of a row.
void putMeasures(const Design& design, const MeasuredTrial& trial, std::span<double> row);

/// Velocities of a profile, of the hand and of the last mass.
inline constexpr std::size_t kProfileNumbers = 202;

}  // namespace reachlab::study
