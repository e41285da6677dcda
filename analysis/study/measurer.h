#pragma once
#include <memory>
#include <vector>

#include "analysis/conclusions/candidates.h"
#include "analysis/conclusions/movement_fit.h"
#include "analysis/measures/paper_error.h"
#include "analysis/study/block_run.h"
#include "analysis/study/trial_row.h"
#include "analysis/trials/run_trials.h"

namespace reachlab::study {

/// Measures the trials of one scene as `analyze` measures recorded trials. Predictions and candidates are made once for all subjects.
/// Criteria that are not defined for the experiment leave their columns empty. One thread.
class Measurer {
 public:
  Measurer(const Design& design, const experiment::CompiledExperiment& experiment);

  /// The latest trial of the run, which was made with samples if the design needs them. `place`: of the trial in its block, from 0.
  MeasuredTrial measure(const BlockRun& run, const record::RecordedTrial& recorded, bool practice, std::size_t place);
  /// The fits of one subject's block, once all its trials were measured: fills in their scores. `first` is the block's first trial.
  void fitBlock(std::vector<MeasuredTrial>& trials, std::size_t first);

 private:
  const Design& design_;
  experiment::CompiledExperiment experiment_;
  Needs needs_;
  analysis::MeasureOptions options_;
  std::vector<predict::Criterion> criteria_;
  std::vector<std::optional<analysis::PredictedSignal>> signals_;  // parallel to criteria_
  analysis::CandidateSet candidates_;
  bool haveCandidates_ = false;
  std::vector<analysis::FitWindow> windows_;  // of the block under way
  std::vector<double> durations_;
  std::vector<std::size_t> windowOf_;  // trial of the block
};

}  // namespace reachlab::study
