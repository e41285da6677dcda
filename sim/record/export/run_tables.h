#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>
#include <string>

#include "sim/record/log/run_log.h"

/// A run as tables of columns, for formats that are written so.
namespace reachlab::record {

/// A small table that is held column by column, for formats that are written so. It is filled cell by cell like TableText. One thread.
class ColumnTable {
 public:
  struct Column {
    std::string name;
    bool isText = false;  // its cells are in `texts`, otherwise in `numbers`
    std::vector<double> numbers = {};
    std::vector<std::string> texts = {};
  };

  explicit ColumnTable(const std::vector<std::string>& names) {
    for (const std::string& name : names) columns_.push_back({name});
  }
  ColumnTable& cell(std::string_view text) {
    Column& column = next();
    column.isText = true;
    column.texts.emplace_back(text);
    return *this;
  }
  ColumnTable& number(double value) {
    next().numbers.push_back(value);
    return *this;
  }
  ColumnTable& whole(long long value) { return number(static_cast<double>(value)); }
  void endRow() {
    at_ = 0;
    ++rows_;
  }
  const std::vector<Column>& columns() const { return columns_; }
  std::size_t rows() const { return rows_; }

 private:
  Column& next() { return columns_[at_++]; }
  std::vector<Column> columns_;
  std::size_t at_ = 0, rows_ = 0;
};

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
