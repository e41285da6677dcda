#pragma once
#include <functional>
#include <span>
#include <string>

#include "sim/record/export/column_table.h"
#include "sim/record/log/run_log.h"

/// A run as tables of columns, for formats that are written so.
namespace reachlab::record {

/// One row per trial, the columns of trials.csv.
ColumnTable trialTable(const RunLog& run);
/// One row per kind of trial and target: kind, target, condition, method, experiment_json. Empty where the run has one scene.
ColumnTable sceneTable(const RunConfiguration& configuration);
/// One row per event: time_s since the run began, event, trial (0: outside a trial), value and text as docs/recording.md lists them.
ColumnTable eventTable(const RunLog& run);

/// Gives every channel of the samples, in the table's order, as one column over the whole run. Only a few columns are in memory at a time:
/// a run that is longer than `mostNumbers` is read several times.
void eachSampleColumn(const RunLog& run, const std::function<void(std::size_t channel, std::span<const double> values)>& take,
                      std::size_t mostNumbers = std::size_t{1} << 22);

/// The one clock of an export: seconds since the run's first sample, from which BIDS counts events. The log itself counts ticks from the
/// start of the run.
class ExportClock {
 public:
  explicit ExportClock(const RunLog& run);
  double at(std::uint64_t tick) const;
  /// A cell of the samples. The two channels of time are converted to this clock.
  double cell(const SampleRows& rows, std::size_t row, std::size_t column) const;

 private:
  std::uint64_t first_;
  std::size_t ticks_ = kNone, measured_ = kNone;  // columns
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

/// The sentence that names the clock of an export's times. Every file that has times carries it.
std::string clockStatement(const RunLog& run);
/// The same for a stream while it is recorded. Its times count from the run's first tick.
std::string clockStatement(const RunConfiguration& configuration);

}  // namespace reachlab::record
