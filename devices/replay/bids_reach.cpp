#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/as_number.h"
#include "base/error.h"
#include "base/fault.h"
#include "base/table_text.h"
#include "base/text_file.h"
#include "devices/replay/reach_checks.h"

namespace reachlab::devices {
namespace {

/// A table whose columns are asked for by their names.
struct NamedTable {
  explicit NamedTable(const std::string& path) : file(path), table(parseTsv(readTextFile(path))) {}

  std::size_t rows() const { return table.rows.size(); }
  bool has(const std::string& column) const { return indexOf(column) < table.columns.size(); }
  const std::string& cell(std::size_t row, const std::string& column) const {
    if (!has(column)) refuse({file, 1}, "column is missing", fmt::format("{}", fmt::join(table.columns, ", ")), column);
    return table.rows[row][indexOf(column)];
  }
  FilePlace placeOf(std::size_t row) const { return {file, static_cast<int>(row) + 2}; }
  std::size_t indexOf(const std::string& column) const {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), column) - table.columns.begin());
  }

  std::string file;
  TsvTable table;
};

// Nothing for n/a.
std::optional<double> cellNumber(const std::string& cell, const FilePlace& place, const std::string& column, const char* allowed) {
  if (cell == "n/a") return std::nullopt;
  const auto value = asNumber<double>(cell);
  if (!value || !std::isfinite(*value)) refuse(place, fmt::format("'{}' is not a number", cell.substr(0, 40)), allowed, column);
  return value;
}

// "…_motion.tsv" to what lies beside it.
std::string beside(const std::string& motion, const std::string& ending) {
  constexpr std::string_view kMotion = "_motion.tsv";
  const std::string base = motion.substr(0, motion.size() - kMotion.size());
  if (isThere(base + ending)) return base + ending;
  // Events belong to the run, not to one tracking system.
  const std::size_t system = base.find("_tracksys-");
  if (system == std::string::npos) return base + ending;
  const std::size_t next = base.find('_', system + 1);
  return base.substr(0, system) + (next == std::string::npos ? "" : base.substr(next)) + ending;
}

// Columns of motion.tsv that give one point's place, and of the times, if there are any.
struct Layout {
  std::array<std::size_t, 3> axis{};
  std::array<double, 3> unit{};  // [m]
  std::optional<std::size_t> latency;
  std::size_t columns = 0;
};

Layout layoutOf(const std::string& file, const ReachColumns& asked) {
  const NamedTable channels(file);
  std::vector<std::string> points;
  for (std::size_t row = 0; row < channels.rows(); ++row)
    if (const std::string& point = channels.cell(row, "tracked_point");
        channels.cell(row, "type") == "POS" && std::find(points.begin(), points.end(), point) == points.end())
      points.push_back(point);
  if (points.empty()) refuse({file}, "has no channel of type POS", "x, y and z of at least one tracked point");
  const std::string oneOfThem = fmt::format("point= with one of {}", fmt::join(points, ", "));
  if (asked.point.empty() && points.size() > 1)
    refuse({file}, fmt::format("has {} tracked points, and none is named", points.size()), oneOfThem);
  const std::string point = asked.point.empty() ? points.front() : asked.point;
  Layout layout;
  std::array<bool, 3> found{};
  layout.columns = channels.rows();
  for (std::size_t row = 0; row < channels.rows(); ++row) {
    if (channels.cell(row, "type") == "LATENCY") layout.latency = row;
    if (channels.cell(row, "type") != "POS" || channels.cell(row, "tracked_point") != point) continue;
    const std::string& component = channels.cell(row, "component");
    if (component != "x" && component != "y" && component != "z") continue;
    const auto k = static_cast<std::size_t>(component[0] - 'x');
    layout.axis[k] = row;
    layout.unit[k] = metresOf(asked.unit.empty() ? channels.cell(row, "units") : asked.unit, channels.placeOf(row));
    found[k] = true;
  }
  if (!found[0] || !found[1] || !found[2]) refuse({file}, "has no x, y and z of type POS for the point " + point, oneOfThem);
  return layout;
}

double rateOf(const std::string& file, const std::optional<double>& asked) {
  if (asked) return *asked;
  if (!isThere(file)) refuse({file}, "is missing, and there is no LATENCY channel", "one of them, or rate=");
  const auto json = nlohmann::json::parse(readTextFile(file), nullptr, false);
  if (json.is_object())
    for (const char* key : {"SamplingFrequencyEffective", "SamplingFrequency"})
      if (json.contains(key) && json[key].is_number() && json[key].get<double>() > 0) return json[key].get<double>();
  refuse({file}, "is missing or no number above 0", "samples a second", "SamplingFrequency");
}

struct Sample {
  double time = 0;  // [s] since the first row
  Vec3 position;
  bool seen = false;
};

std::vector<Sample> samplesOf(const std::string& motion, const Layout& layout, const ReachColumns& asked) {
  if (layout.latency && asked.rate) refuse({motion}, "has a LATENCY channel beside rate=", "one of them");
  std::istringstream in(readTextFile(motion));
  const double rate = layout.latency ? 0 : rateOf(beside(motion, "_motion.json"), asked.rate);
  std::vector<Sample> samples;
  double begin = 0;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line + '\t');
    for (std::string cell; std::getline(parts, cell, '\t');) cells.push_back(cell);
    const FilePlace place{motion, number};
    if (cells.size() != layout.columns)
      refuse(place, fmt::format("has {} cells", cells.size()), fmt::format("{}, as its channels", layout.columns));
    const auto valueOf = [&](std::size_t column) {
      return cellNumber(cells[column], place, fmt::format("column {}", column + 1), "a number or n/a (motion.tsv has no header)");
    };
    Sample sample;
    if (layout.latency) {
      const auto time = valueOf(*layout.latency);
      if (!time) continue;  // a row of no time cannot be placed
      if (samples.empty()) begin = *time;
      sample.time = *time - begin;
    } else {
      sample.time = static_cast<double>(samples.size()) / rate;
    }
    std::array<double, 3> at{};
    sample.seen = true;
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto value = valueOf(layout.axis[k])) at[k] = layout.unit[k] * *value;
      else sample.seen = false;
    sample.position = {at[0], at[1], at[2]};
    samples.push_back(sample);
  }
  if (samples.empty()) refuse({motion}, "has no samples", "at least one row");
  return samples;
}

struct ReachSpan {
  double begin = 0, end = 0;  // [s] since the first row
};

// Of our own recordings: in a catch trial, and in a trial without a movement time, the hand stays at the start.
bool isWithoutReach(const NamedTable& events, std::size_t row) {
  return events.has("movement_time") && (events.cell(row, "trial_type") == "catch" || events.cell(row, "movement_time") == "n/a");
}

std::vector<ReachSpan> reachesIn(const std::string& file, const std::string& trialType) {
  const NamedTable events(file);
  std::vector<ReachSpan> spans;
  bool stayed = false;
  for (std::size_t row = 0; row < events.rows(); ++row) {
    if (!trialType.empty() && (!events.has("trial_type") || events.cell(row, "trial_type") != trialType)) continue;
    if (isWithoutReach(events, row)) {
      stayed = true;
      continue;
    }
    const auto valueOf = [&](const std::string& column) {
      return cellNumber(events.cell(row, column), events.placeOf(row), column, "a number or n/a");
    };
    const auto onset = valueOf("onset"), lasts = valueOf("duration");
    if (onset && lasts && *lasts > 0) spans.push_back({*onset, *onset + *lasts});
  }
  if (spans.empty() && !stayed)
    refuse({file}, fmt::format("has no event{} that lasts", trialType.empty() ? "" : " of trial_type " + trialType),
           "at least one with onset and duration");
  return spans;
}

}  // namespace

std::vector<RecordedReach> readBidsReaches(const std::string& motion, const ReachColumns& columns) {
  const std::string channels = beside(motion, "_channels.tsv"), events = beside(motion, "_events.tsv");
  if (!isThere(motion)) throw ResourceError(motion + ": cannot be opened");
  if (!isThere(channels)) refuse({channels}, "is missing", "the channels of motion.tsv beside it");
  const std::vector<Sample> samples = samplesOf(motion, layoutOf(channels, columns), columns);
  std::vector<ReachSpan> spans{{samples.front().time, samples.back().time}};
  if (isThere(events)) spans = reachesIn(events, columns.trialType);
  std::vector<RecordedReach> reaches;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    SeenSamples reach(spans.size() == 1 ? motion : fmt::format("{}: event {}", motion, i + 1));
    for (const Sample& sample : samples)
      if (sample.seen && sample.time >= spans[i].begin && sample.time <= spans[i].end) reach.add(sample.time, sample.position);
    reaches.push_back(reach.take());
  }
  return reaches;
}

}  // namespace reachlab::devices
