#include "sim/record/export/run_tables.h"

#include <fmt/format.h>

#include <cmath>

#include "base/ticks.h"
#include "sim/record/export/trial_row.h"

namespace reachlab::record {

ColumnTable trialTable(const RunLog& run) {
  ColumnTable table(trialColumnNames());
  eachTrial(run, [&](std::span<const TrialCell> cells) { addTrial(table, cells); });
  return table;
}

ColumnTable sceneTable(const RunConfiguration& configuration) {
  ColumnTable table({"kind", "target", "condition", "method", "experiment_json"});
  for (const RunScene& scene : configuration.scenes.value_or(std::vector<RunScene>())) {
    table.cell(scene.kind).cell(scene.target).cell(scene.condition).cell(scene.method).cell(scene.experimentText);
    table.endRow();
  }
  return table;
}

ColumnTable eventTable(const RunLog& run) {
  ColumnTable table({"time_s", "event", "trial", "value", "text"});
  const ExportClock clock(run);
  for (const RecordedEvent& event : run.events()) {
    table.number(clock.at(event.tick)).cell(nameOf(event.kind)).whole(event.trial).number(event.value).cell(event.text);
    table.endRow();
  }
  return table;
}

void eachSampleColumn(const RunLog& run, const std::function<void(std::size_t, std::span<const double>)>& take, std::size_t mostNumbers) {
  std::size_t rows = 0;
  const ExportClock clock(run);
  run.eachBlock([&](const SampleRows& block) { rows += block.size(); });
  const std::size_t channels = run.configuration().table.size();
  const std::size_t atOnce = std::clamp<std::size_t>(mostNumbers / std::max<std::size_t>(rows, 1), 1, std::max<std::size_t>(channels, 1));
  std::vector<std::vector<double>> columns(std::min(atOnce, channels));
  for (std::size_t first = 0; first < channels; first += atOnce) {
    const std::size_t count = std::min(atOnce, channels - first);
    for (std::size_t k = 0; k < count; ++k) columns[k].clear();
    run.eachBlock([&](const SampleRows& block) {
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t row = 0; row < block.size(); ++row) columns[k].push_back(clock.cell(block, row, first + k));
    });
    for (std::size_t k = 0; k < count; ++k) take(first + k, columns[k]);
  }
}

namespace {

std::string clockStatement(const RunConfiguration& c, const std::string& origin) {
  const std::string began =
      c.startedUtc.empty() ? "at a time that was not recorded" : "at " + c.startedUtc + " by the system's clock (UTC)";
  const std::string ticks = fmt::format("Times are seconds since {}, counted in ticks of 1 ms", origin);
  if (c.clock == "virtual") return fmt::format("{} of a virtual clock that ran as fast as it could; the run began {}.", ticks, began);
  return fmt::format("{}; measured_s is the same by the computer's monotonic clock (CLOCK_MONOTONIC); the run began {}.", ticks, began);
}

}  // namespace

std::string clockStatement(const RunConfiguration& configuration) { return clockStatement(configuration, "the run's first tick"); }

std::string clockStatement(const RunLog& run) {
  return clockStatement(run.configuration(),
                        fmt::format("the run's first sample, which is {} s after it began", secondsOf(run.firstSampleTick())));
}

ExportClock::ExportClock(const RunLog& run) : first_(run.firstSampleTick()) {
  const auto& channels = run.configuration().table.channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].type == "LATENCY") ticks_ = i;
    if (channels[i].name == "measured_time") measured_ = i;
  }
}

double ExportClock::at(std::uint64_t tick) const { return secondsBetween(first_, tick); }

double ExportClock::cell(const SampleRows& rows, std::size_t row, std::size_t column) const {
  if (column == ticks_) return at(rows.ticks[row]);
  const double value = rows.at(row, column);
  if (column != measured_) return value;
  constexpr double kNanoseconds = 1e9;  // what the clock counts: the difference is rounded to it
  return std::round((value - secondsOf(first_)) * kNanoseconds) / kNanoseconds;
}

}  // namespace reachlab::record
