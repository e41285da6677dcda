#include "sim/record/export/run_tables.h"

#include "sim/record/export/trial_row.h"

namespace reachlab::record {

ColumnTable trialTable(const RunLog& run) {
  ColumnTable table(kTrialColumns);
  const experiment::Task task = taskOf(run.configuration());
  for (const RecordedTrial& trial : run.trials()) addTrial(table, run.configuration(), task, trial);
  return table;
}

ColumnTable eventTable(const RunLog& run) {
  ColumnTable table({"time_s", "event", "trial", "value", "text"});
  for (const RecordedEvent& event : run.events()) {
    table.number(secondsOf(event.tick)).cell(nameOf(event.kind)).whole(event.trial).number(event.value).cell(event.text);
    table.endRow();
  }
  return table;
}

void eachSampleColumn(const RunLog& run, const std::function<void(std::size_t, std::span<const double>)>& take, std::size_t mostNumbers) {
  std::size_t rows = 0;
  run.eachBlock([&](const SampleRows& block) { rows += block.size(); });
  const std::size_t channels = run.configuration().table.size();
  const std::size_t atOnce = std::clamp<std::size_t>(mostNumbers / std::max<std::size_t>(rows, 1), 1, std::max<std::size_t>(channels, 1));
  std::vector<std::vector<double>> columns(std::min(atOnce, channels));
  for (std::size_t first = 0; first < channels; first += atOnce) {
    const std::size_t count = std::min(atOnce, channels - first);
    for (std::size_t k = 0; k < count; ++k) columns[k].clear();
    run.eachBlock([&](const SampleRows& block) {
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t row = 0; row < block.size(); ++row) columns[k].push_back(block.at(row, first + k));
    });
    for (std::size_t k = 0; k < count; ++k) take(first + k, columns[k]);
  }
}

std::string clockStatement(const RunConfiguration& c) {
  const std::string began =
      c.startedUtc.empty() ? "at a time that was not recorded" : "at " + c.startedUtc + " by the system's clock (UTC)";
  if (c.clock == "virtual")
    return "Times are seconds since the run's first tick, counted in ticks of 1 ms of a virtual clock that ran as fast as it could; the run began " +
           began + ".";
  return "Times are seconds since the run's first tick, counted in ticks of 1 ms; measured_s is the same by the computer's monotonic clock "
         "(CLOCK_MONOTONIC); the run began " +
         began + ".";
}

}  // namespace reachlab::record
