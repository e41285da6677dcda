#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "sim/analyze/dataset.h"
#include "sim/record/append_file.h"
#include "sim/record/bids.h"
#include "base/table_text.h"

namespace reachlab::analyze {
namespace {

namespace fs = std::filesystem;

double numberOf(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : kNotMeasured;
}

std::size_t columnOf(const TsvTable& table, const std::string& name, const fs::path& file) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found == table.columns.end()) throw UsageError(fmt::format("{}: no column {}", file.string(), name));
  return static_cast<std::size_t>(found - table.columns.begin());
}

/// "sub-01_ses-02_…": the label behind `key`.
std::string labelIn(const std::string& name, const std::string& key) {
  const std::size_t at = name.find(key + "-");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + key.size() + 1;
  return name.substr(begin, name.find_first_of("_.", begin) - begin);
}

std::uint64_t tickOf(double seconds) { return std::isfinite(seconds) ? static_cast<std::uint64_t>(std::llround(seconds * 1000)) : 0; }

record::ChannelTable readChannels(const fs::path& path) {
  const TsvTable text = parseTsv(record::readWholeFile(path.string()));
  const std::size_t name = columnOf(text, "name", path);
  record::ChannelTable table;
  for (const auto& row : text.rows) {
    record::Channel channel;
    channel.name = row.at(name);
    if (channel.name.starts_with("mass") && channel.name.ends_with("_pos_x")) ++table.massCount;
    if (channel.name.starts_with("mass1_q") && !channel.name.ends_with("_rate")) ++table.parameterCount;
    table.channels.push_back(channel);
  }
  return table;
}

record::SampleRows readMotion(const fs::path& path, std::size_t columns) {
  const std::string text = record::readWholeFile(path.string());
  record::SampleRows rows;
  rows.columns = columns;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    const std::size_t before = rows.values.size();
    for (bool more = true; more && at < end;) {
      double value = kNotMeasured;
      at = std::from_chars(at, end, value).ptr;
      while (at < end && *at != '\t' && *at != '\n') ++at;  // "n/a"
      more = at < end && *at == '\t';
      if (at < end) ++at;
      rows.values.push_back(value);
    }
    if (rows.values.size() - before != columns)
      throw UsageError(fmt::format("{}: row {} has {} columns, channels.tsv has {}", path.string(), rows.ticks.size() + 1,
                                   rows.values.size() - before, columns));
    rows.ticks.push_back(tickOf(rows.values[before]));  // the first channel is the run's own clock
  }
  return rows;
}

trial::Outcome outcomeFrom(const std::string& text) {
  for (const trial::Outcome o : {trial::Outcome::Success, trial::Outcome::Failure, trial::Outcome::Aborted, trial::Outcome::Interrupted})
    if (trial::nameOf(o) == text) return o;
  return trial::Outcome::None;
}

trial::Reason reasonFrom(const std::string& text) {
  for (int i = 0; i <= static_cast<int>(trial::Reason::FalseStart); ++i)
    if (trial::nameOf(static_cast<trial::Reason>(i)) == text) return static_cast<trial::Reason>(i);
  return trial::Reason::None;
}

/// When the trial was armed is no column of events.tsv: it is the first of the rows before its end in which the phase says so.
std::uint64_t armedTickOf(const record::SampleRows& rows, const record::ChannelTable& table, int trial) {
  const std::size_t trialColumn = table.indexOf("trial"), phase = table.indexOf("phase");
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (static_cast<int>(rows.at(row, trialColumn)) == trial && rows.at(row, phase) >= 2 && rows.at(row, phase) <= 3)
      return rows.ticks[row];
  return 0;
}

RunSource readRun(const fs::path& motion) {
  const std::string name = motion.filename().string();
  const auto sibling = [&](const std::string& ending) {
    return motion.parent_path() / (name.substr(0, name.size() - std::string("motion.tsv").size()) + ending);
  };
  RunSource run;
  record::RunConfiguration& c = run.configuration;
  c.subject = labelIn(name, "sub");
  c.session = labelIn(name, "ses");
  c.task = labelIn(name, "task");
  c.run = static_cast<int>(numberOf(labelIn(name, "run")));
  c.table = readChannels(sibling("channels.tsv"));
  c.device = "n/a";
  const auto about = nlohmann::json::parse(record::readWholeFile(sibling("motion.json").string()), nullptr, false);
  if (about.is_object()) c.experimentName = record::experimentNameIn(about.value("TaskDescription", ""));

  auto rows = std::make_shared<record::SampleRows>(readMotion(motion, c.table.size()));
  if (rows->size() > 1) c.sampleEveryTicks = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, rows->ticks[1] - rows->ticks[0]));
  c.samplingHz = 1000.0 / c.sampleEveryTicks;

  const fs::path eventsFile = sibling("events.tsv");
  const TsvTable events = parseTsv(record::readWholeFile(eventsFile.string()));
  const auto column = [&](const char* key) { return columnOf(events, key, eventsFile); };
  for (const auto& row : events.rows) {
    record::RecordedTrial trial;
    trial.trial = static_cast<int>(numberOf(row.at(column("trial"))));
    trial.planned.catchTrial = row.at(column("trial_type")) == "catch";
    trial.result.outcome = outcomeFrom(row.at(column("outcome")));
    trial.result.reason = reasonFrom(row.at(column("reason")));
    trial.result.mass = static_cast<int>(numberOf(row.at(column("mass"))));
    trial.result.by = numberOf(row.at(column("by")));
    const double onset = numberOf(row.at(column("onset"))), duration = numberOf(row.at(column("duration")));
    const double movement = numberOf(row.at(column("movement_time")));
    trial.result.movementTime = std::isfinite(movement) ? movement : 0;
    trial.result.onsetTick = std::isfinite(movement) ? tickOf(onset) : 0;
    trial.result.endTick = tickOf(onset + duration);
    trial.goTick = tickOf(numberOf(row.at(column("go"))));
    trial.armedTick = armedTickOf(*rows, c.table, trial.trial);
    trial.startTick = trial.armedTick;
    trial.lastTick = trial.result.endTick;
    trial.peakForce = numberOf(row.at(column("peak_force")));
    c.block = static_cast<int>(numberOf(row.at(column("block"))));
    c.practice = row.at(column("phase")) == "practice";
    c.condition = row.at(column("condition"));
    run.trials.push_back(trial);
  }
  run.rowsOf = [rows](std::uint64_t first, std::uint64_t last) {
    record::SampleRows part;
    part.columns = rows->columns;
    for (std::size_t row = 0; row < rows->size(); ++row) {
      if (rows->ticks[row] < first || rows->ticks[row] > last) continue;
      part.ticks.push_back(rows->ticks[row]);
      const auto begin = rows->values.begin() + static_cast<std::ptrdiff_t>(row * rows->columns);
      part.values.insert(part.values.end(), begin, begin + static_cast<std::ptrdiff_t>(rows->columns));
    }
    return part;
  };
  return run;
}

}  // namespace

std::vector<RunSource> readBidsRuns(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw UsageError(folder + ": no such folder");
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, error))
    if (const std::string name = entry.path().filename().string();
        name.ends_with("_motion.tsv") && name.find("_tracksys-haptic") != std::string::npos)
      files.push_back(entry.path());
  if (files.empty()) throw UsageError(folder + ": neither logs (sourcedata/…_log.reach) nor motion files (…_tracksys-haptic_…_motion.tsv)");
  std::sort(files.begin(), files.end());
  std::vector<RunSource> runs;
  for (const fs::path& file : files) runs.push_back(readRun(file));
  return runs;
}

}  // namespace reachlab::analyze
