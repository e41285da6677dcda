#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "analysis/dataset.h"
#include "base/as_number.h"
#include "base/fault.h"
#include "base/table_text.h"
#include "base/text_file.h"
#include "base/ticks.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/bids.h"
#include "sim/record/log/run_names.h"
#include "sim/record/log/whole_file.h"

namespace reachlab::analysis {
namespace {

namespace fs = std::filesystem;

/// The number of a cell; kNotMeasured for n/a. A text that only begins with a number, such as 1,5, is refused under `key`.
double numberOf(std::string_view cell, const char* key, const std::string& file, int line = 0) {
  if (const auto value = asNumber<double>(cell)) return *value;
  if (!cell.empty() && cell != "n/a")
    throw FaultError(Fault{key, fmt::format("'{}' is not a number", cell.substr(0, 40)), "a number with a decimal point, or n/a",
                           FilePlace{file, line}});
  return kNotMeasured;
}

std::size_t columnOf(const TsvTable& table, const std::string& name, const fs::path& file) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  if (found == table.columns.end()) throw FaultError(Fault{{}, "no column " + name, {}, FilePlace{file.string()}});
  return static_cast<std::size_t>(found - table.columns.begin());
}

constexpr double kMaxRunDuration = 1e6;  // [s]

std::uint64_t tickOf(double seconds) {
  if (!std::isfinite(seconds)) return 0;
  if (!(seconds >= 0 && seconds <= kMaxRunDuration))
    throw FaultError(Fault{"time", fmt::format("is {} s", seconds), fmt::format("0 to {:.0f} s", kMaxRunDuration)});
  return static_cast<std::uint64_t>(std::llround(seconds * kTicksPerSecond));
}

// A whole number; 0 where there is none.
int countOf(double number) {
  constexpr double kMost = 1e9;
  return std::isfinite(number) && number >= 0 && number <= kMost ? static_cast<int>(number) : 0;
}

// Vectors are read from their x on, and numbers without a conversion: units and the order of components have to be those of an export.
void checkChannels(const record::ChannelTable& table, const fs::path& path) {
  experiment::Experiment experiment;
  experiment.object.masses.resize(static_cast<std::size_t>(table.massCount));
  const record::ChannelTable exported = record::makeChannelTable(experiment, table.parameterCount);
  const auto require = [&](std::size_t i, const record::Channel& wanted) {
    const record::Channel found = i < table.size() ? table.channels[i] : record::Channel{};
    if (found.name != wanted.name || found.units != wanted.units)
      throw FaultError(Fault{fmt::format("channel {}", i + 1), fmt::format("is \"{}\" in {}", found.name, found.units),
                             fmt::format("{} in {}, as an export of Reachlab has it", wanted.name, wanted.units),
                             FilePlace{path.string()}});
  };
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto& all = exported.channels;
    const auto known = std::find_if(all.begin(), all.end(), [&](const record::Channel& c) { return c.name == table.channels[i].name; });
    if (known == all.end()) continue;
    const std::ptrdiff_t components = known->name.ends_with("_x") ? 3 : 1;
    for (std::ptrdiff_t k = 0; k < components; ++k) require(i + static_cast<std::size_t>(k), known[k]);
  }
}

record::ChannelTable readChannels(const fs::path& path) {
  const TsvTable text = parseTsv(record::readWholeFile(path.string()));
  const std::size_t name = columnOf(text, "name", path), units = columnOf(text, "units", path);
  record::ChannelTable table;
  for (const auto& row : text.rows) {
    record::Channel channel;
    channel.name = row.at(name);
    channel.units = row.at(units);
    if (channel.name.starts_with("mass") && channel.name.ends_with("_pos_x")) ++table.massCount;
    if (channel.name.starts_with("mass1_q") && !channel.name.ends_with("_rate")) ++table.parameterCount;
    if (channel.name == "environment_force_x") table.environment = true;
    if (channel.name == "cursor_pos_x") table.cursor = true;
    if (channel.name == "body_quat_w") table.body = true;
    table.channels.push_back(channel);
  }
  checkChannels(table, path);
  return table;
}

// Rows in which the hand was not seen are left out, as if they had not been written.
record::SampleRows readMotion(const fs::path& path, const record::ChannelTable& table) {
  const std::string text = record::readWholeFile(path.string());
  const std::size_t columns = table.size(), hand = table.indexOf("hand_pos_x");
  int line = 0;
  record::SampleRows rows;
  rows.columns = columns;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    const std::size_t before = rows.values.size();
    ++line;
    for (bool more = true; more && at < end;) {
      const char* const cell = at;
      at = std::find_if(cell, end, [](char c) { return c == '\t' || c == '\n'; });
      const std::string_view number(cell, static_cast<std::size_t>(at - cell));
      rows.values.push_back(numberOf(number.substr(0, number.find('\r')), "", path.native(), line));
      more = at < end && *at == '\t';
      if (at < end) ++at;
    }
    if (rows.values.size() - before != columns)
      throw FaultError(Fault{{},
                             fmt::format("has {} columns", rows.values.size() - before),
                             fmt::format("{}, as channels.tsv", columns),
                             FilePlace{path.string(), line}});
    const auto place = rows.values.begin() + static_cast<std::ptrdiff_t>(before + hand);
    if (!std::all_of(place, place + 3, [](double v) { return std::isfinite(v); })) {
      rows.values.resize(before);
      continue;
    }
    rows.ticks.push_back(tickOf(rows.values[before]));  // the first channel is the run's own clock
  }
  return rows;
}

// Tables from before there were kinds have no such columns.
int sceneIn(const TsvTable& events, const std::vector<std::string>& row, record::RunConfiguration& c) {
  const auto cell = [&](const char* name) {
    const auto found = std::find(events.columns.begin(), events.columns.end(), name);
    const std::string text = found == events.columns.end() ? "" : row.at(static_cast<std::size_t>(found - events.columns.begin()));
    return text == "n/a" ? std::string() : text;
  };
  const std::string kind = cell("kind"), target = cell("target");
  if (kind.empty() && target.empty()) return 0;
  std::vector<record::RunScene>& scenes = c.scenes ? *c.scenes : c.scenes.emplace();
  const auto known =
      std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return scene.kind == kind && scene.target == target; });
  if (known != scenes.end()) return static_cast<int>(known - scenes.begin());
  scenes.push_back({kind, target, cell("condition"), {}, {}, {}});
  return static_cast<int>(scenes.size()) - 1;
}

/// Ticks from one row to the next: as the description says, else as the first two rows lie, else 10.
std::uint32_t ticksOfSample(const nlohmann::json& about, const record::SampleRows& rows) {
  double frequency = about.is_object() && about.contains("SamplingFrequency") && about["SamplingFrequency"].is_number()
                         ? about["SamplingFrequency"].get<double>()
                         : 0.0;
  if (!(frequency > 0) && rows.size() > 1) frequency = kTicksPerSecond / static_cast<double>(rows.ticks[1] - rows.ticks[0]);
  if (!(frequency > 0)) frequency = 100;
  return static_cast<std::uint32_t>(std::clamp<double>(std::round(kTicksPerSecond / frequency), 1, 1e6));
}

/// One row of events.tsv, whose times count from the first row of the recording, at `begin` [s].
struct EventRow {
  const TsvTable& events;
  const fs::path& file;
  std::size_t index = 0;
  double begin = 0;

  int line() const { return static_cast<int>(index) + 2; }
  const std::string& text(const char* key) const { return events.rows[index].at(columnOf(events, key, file)); }
  double number(const char* key) const { return numberOf(text(key), key, file.native(), line()); }
  int count(const char* key) const { return countOf(number(key)); }
  std::uint64_t tick(const char* key) const { return tickOf(number(key) + begin); }
  /// The place of the word in `allowed`. n/a is the first.
  std::size_t word(const char* key, const std::vector<std::string_view>& allowed) const {
    const auto known = std::find(allowed.begin(), allowed.end(), text(key));
    if (known != allowed.end()) return static_cast<std::size_t>(known - allowed.begin());
    if (text(key) == "n/a") return 0;
    throw FaultError(Fault{key, fmt::format("is '{}', which is unknown", text(key)), fmt::format("{}", fmt::join(allowed, ", ")),
                           FilePlace{file.native(), line()}});
  }
  template <class Named>
  Named named(const char* key, Named last) const {
    std::vector<std::string_view> names;
    for (int i = 0; i <= static_cast<int>(last); ++i) names.push_back(nameOf(static_cast<Named>(i)));
    return static_cast<Named>(word(key, names));
  }
};

record::RecordedTrial trialOf(const EventRow& row, const record::SampleRows& rows) {
  record::RecordedTrial trial;
  trial.trial = row.count("trial");
  trial.planned.catchTrial = row.word("trial_type", {"reach", "catch"}) == 1;
  trial.result.outcome = row.named("outcome", trial::Outcome::Interrupted);
  trial.result.reason = row.named("reason", trial::kLastReason);
  trial.result.mass = row.count("mass");
  trial.result.by = row.number("by");
  const double movement = row.number("movement_time");
  trial.result.movementTime = std::isfinite(movement) ? movement : 0;
  trial.result.onsetTick = std::isfinite(movement) ? row.tick("onset") : 0;
  trial.result.endTick = tickOf(row.number("onset") + row.number("duration") + row.begin);
  constexpr std::uint64_t kBeyond = kTicksPerSecond;  // the last rows of a recording that broke off may be missing
  if (rows.size() > 1 && trial.result.endTick > rows.ticks.back() + kBeyond)
    throw FaultError(Fault{"onset",
                           fmt::format("and duration end at {:g} s, and the recording at {:g} s",
                                       secondsOf(trial.result.endTick) - row.begin, secondsOf(rows.ticks.back()) - row.begin),
                           "times within the recording, in s since its first row", FilePlace{row.file.string(), row.line()}});
  trial.goTick = row.tick("go");
  trial.armedTick = row.tick("armed");
  trial.startTick = trial.armedTick;
  trial.lastTick = trial.result.endTick;
  trial.peakForce = row.number("peak_force");
  trial.meanForce = row.number("mean_force");
  return trial;
}

RunSource readRun(const fs::path& motion) {
  const std::string name = motion.filename().string();
  const auto sibling = [&](const std::string& ending) {
    return motion.parent_path() / (name.substr(0, name.size() - std::string("motion.tsv").size()) + ending);
  };
  RunSource run;
  record::RunConfiguration& c = run.configuration;
  c.subject = record::labelIn(name, "sub");
  c.session = record::labelIn(name, "ses");
  c.task = record::labelIn(name, "task");
  c.run = countOf(numberOf(record::labelIn(name, "run"), "run", motion.native()));
  c.table = readChannels(sibling("channels.tsv"));
  c.device = "n/a";
  const auto about = nlohmann::json::parse(record::readWholeFile(sibling("motion.json").string()), nullptr, false);
  if (about.is_object() && about.contains("TaskDescription") && about["TaskDescription"].is_string())
    c.experimentName = record::experimentNameIn(about.value("TaskDescription", ""));

  auto rows = std::make_shared<record::SampleRows>(readMotion(motion, c.table));
  for (std::size_t row = 1; row < rows->size(); ++row)
    if (rows->ticks[row] <= rows->ticks[row - 1])
      throw FaultError(Fault{"time", "does not increase", "increasing times", FilePlace{motion.string(), static_cast<int>(row + 1)}});
  c.sampleEveryTicks = ticksOfSample(about, *rows);
  c.samplingHz = kTicksPerSecond / c.sampleEveryTicks;

  const fs::path eventsFile = sibling("events.tsv");
  const TsvTable events = parseTsv(record::readWholeFile(eventsFile.string()));
  // Asked for before the first row too: what is no table of events at all would else be a run of no trials.
  for (const char* key : {"onset", "duration", "trial_type", "trial", "block", "phase", "condition", "outcome", "reason", "mass", "by",
                          "movement_time", "armed", "go", "peak_force", "mean_force", "day"})
    columnOf(events, key, eventsFile);
  double begin = rows->size() == 0 ? 0 : secondsOf(rows->ticks.front());
  // Tick 0 means never, so the first row lies a sample behind it, as in a log. Only times between ticks are used.
  if (rows->size() > 0 && rows->ticks.front() < c.sampleEveryTicks) {
    const std::uint64_t later = c.sampleEveryTicks - rows->ticks.front();
    for (std::uint64_t& tick : rows->ticks) tick += later;
    begin += secondsOf(later);
  }
  for (std::size_t index = 0; index < events.rows.size(); ++index) {
    const EventRow row{events, eventsFile, index, begin};
    record::RecordedTrial& trial = run.trials.emplace_back(trialOf(row, *rows));
    c.day = row.count("day");
    c.block = row.count("block");
    c.practice = row.word("phase", {"recorded", "practice"}) == 1;
    c.condition = row.text("condition");
    trial.planned.scene = sceneIn(events, events.rows[index], c);
  }
  run.rowsOf = [rows](std::uint64_t first, std::uint64_t last) { return rows->between(first, last); };
  return run;
}

/// Several datasets below one folder are often a dataset and its copy, whose trials would count twice.
void requireOneDataset(const std::vector<std::string>& files, const std::string& folder) {
  const std::string first = datasetOf(files.front());
  for (const std::string& file : files)
    if (const std::string other = datasetOf(file); other != first)
      throw FaultError(Fault{{}, fmt::format("holds several datasets, {} and {}", first, other), "one of them", FilePlace{folder}});
}

}  // namespace

std::vector<std::string> findBidsRuns(const std::string& folder) {
  requireSearchable(folder);
  if (!isFolder(folder)) throw FaultError(Fault{{}, "no such folder", {}, FilePlace{folder}});
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (const std::string name = entry.path().filename().string();
        name.ends_with("_motion.tsv") && name.find("_tracksys-haptic_") != std::string::npos)
      files.push_back(entry.path().string());
  if (files.empty())
    throw FaultError(
        Fault{{}, "neither logs (sourcedata/…_log.reach) nor motion files (…_tracksys-haptic_…_motion.tsv)", {}, FilePlace{folder}});
  std::sort(files.begin(), files.end(), record::runBefore);
  requireOneDataset(files, folder);
  return files;
}

RunSource readBidsRun(const std::string& motionFile) {
  try {
    return readRun(motionFile);
  } catch (const FaultError& error) {
    throw FaultError(inFile(motionFile, error.faults));
  }
}

}  // namespace reachlab::analysis
