#pragma once
#include <cstdint>
#include <functional>

#include "analysis/trials/trial_data.h"
#include "constraints/geometry/task_path.h"
#include "sim/record/configuration/channels.h"
#include "sim/record/log/run_log.h"

namespace reachlab::analysis {

/// Turns the rows of one run into trials as the analysis takes them. A value, for any thread.
class RunTrials {
 public:
  /// `every`: ticks between two rows.
  RunTrials(const record::ChannelTable& table, std::uint64_t every, constraints::TaskPath path, const TrialScene& scene);

  /// Gives the rows between two ticks, both included.
  using RowsBetween = std::function<record::SampleRows(std::uint64_t first, std::uint64_t last)>;
  /// The trial from its arming to its end, without key and practice. The movement ends with the trial: a later
  /// motion of the hand is no part of it.
  TrialData read(const record::RecordedTrial& recorded, const RowsBetween& rowsOf) const;

 private:
  struct Columns {  // their positions in the table
    std::size_t hand = 0, force = 0, object = 0, velocity = 0;
    std::size_t parameter = 0;                      // of mass 1, on curves
    std::size_t handVelocity = 0, environment = 0;  // 0: the table has none
  };
  void appendEvenly(TrialData& trial, const record::SampleRows& rows, std::uint64_t onset) const;

  Columns columns_;
  std::uint64_t every_;
  constraints::TaskPath path_;
  TrialScene scene_;
};

}  // namespace reachlab::analysis
