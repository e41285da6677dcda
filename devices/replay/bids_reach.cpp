#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/as_number.h"
#include "base/error.h"
#include "base/fault.h"
#include "base/json/json_tree.h"
#include "base/table_text.h"
#include "base/text_file.h"
#include "devices/replay/recorded_reach.h"

namespace reachlab::devices {
namespace {

namespace fs = std::filesystem;

// A named column of a table.
class TsvColumns {
 public:
  TsvColumns(std::string file, const std::string& text) : file_(std::move(file)), table_(parseTsv(text)) {}
  const std::string& cell(std::size_t row, const std::string& column) const {
    const auto at = std::find(table_.columns.begin(), table_.columns.end(), column);
    if (at == table_.columns.end())
      throw FaultError(Fault{column, "column is missing", fmt::format("{}", fmt::join(table_.columns, ", ")), FilePlace{file_, 1}});
    return table_.rows[row][static_cast<std::size_t>(at - table_.columns.begin())];
  }
  bool has(const std::string& column) const {
    return std::find(table_.columns.begin(), table_.columns.end(), column) != table_.columns.end();
  }
  std::size_t rows() const { return table_.rows.size(); }

 private:
  std::string file_;
  TsvTable table_;
};

// "…_motion.tsv" to what lies beside it.
std::string beside(const std::string& motion, const std::string& ending) {
  constexpr std::string_view kMotion = "_motion.tsv";
  const std::string base = motion.substr(0, motion.size() - kMotion.size());
  std::error_code error;
  if (fs::exists(base + ending, error)) return base + ending;
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
  const TsvColumns channels(file, readTextFile(file));
  std::vector<std::string> points;
  for (std::size_t row = 0; row < channels.rows(); ++row)
    if (const std::string& point = channels.cell(row, "tracked_point");
        channels.cell(row, "type") == "POS" && std::find(points.begin(), points.end(), point) == points.end())
      points.push_back(point);
  if (points.empty())
    throw FaultError(Fault{{}, "has no channel of type POS", "x, y and z of at least one tracked point", FilePlace{file}});
  if (asked.point.empty() && points.size() > 1)
    throw FaultError(Fault{{},
                           fmt::format("has {} tracked points, and none is named", points.size()),
                           fmt::format("point= with one of {}", fmt::join(points, ", ")),
                           FilePlace{file}});
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
    layout.unit[k] = metresOf(asked.unit.empty() ? channels.cell(row, "units") : asked.unit, FilePlace{file, static_cast<int>(row) + 2});
    found[k] = true;
  }
  if (std::find(found.begin(), found.end(), false) != found.end())
    throw FaultError(Fault{{},
                           "has no x, y and z of type POS for the point " + point,
                           fmt::format("point= with one of {}", fmt::join(points, ", ")),
                           FilePlace{file}});
  return layout;
}

double rateOf(const std::string& file, const std::optional<double>& asked) {
  if (asked) return *asked;
  std::error_code error;
  if (!fs::exists(file, error))
    throw FaultError(Fault{{}, "is missing, and there is no LATENCY channel", "one of them, or rate=", FilePlace{file}});
  const auto json = nlohmann::json::parse(readTextFile(file), nullptr, false);
  if (json.is_object())
    for (const char* key : {"SamplingFrequencyEffective", "SamplingFrequency"})
      if (json.contains(key) && json[key].is_number() && json[key].get<double>() > 0) return json[key].get<double>();
  throw FaultError(Fault{"SamplingFrequency", "is missing or no number above 0", "samples a second", FilePlace{file}});
}

struct Sample {
  double time = 0;  // [s] since the first row
  Vec3 position;
  bool seen = false;
};

std::vector<Sample> samplesOf(const std::string& motion, const Layout& layout, const ReachColumns& asked) {
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
    if (cells.size() != layout.columns)
      throw FaultError(Fault{
          {}, fmt::format("has {} cells", cells.size()), fmt::format("{}, as its channels", layout.columns), FilePlace{motion, number}});
    const auto valueOf = [&](std::size_t column) -> std::optional<double> {
      const std::string& cell = cells[column];
      if (cell == "n/a") return std::nullopt;
      const auto value = asNumber<double>(cell);
      if (!value || !std::isfinite(*value))
        throw FaultError(Fault{fmt::format("column {}", column + 1), fmt::format("'{}' is not a number", cell.substr(0, 40)),
                               "a number or n/a (motion.tsv has no header)", FilePlace{motion, number}});
      return value;
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
  if (samples.empty()) throw FaultError(Fault{{}, "has no samples", "at least one row", FilePlace{motion}});
  return samples;
}

struct ReachSpan {
  double begin = 0, end = 0;  // [s] since the first row
};

std::vector<ReachSpan> reachesIn(const std::string& file, const std::string& trialType) {
  const TsvColumns events(file, readTextFile(file));
  std::vector<ReachSpan> spans;
  for (std::size_t row = 0; row < events.rows(); ++row) {
    if (!trialType.empty() && (!events.has("trial_type") || events.cell(row, "trial_type") != trialType)) continue;
    const auto valueOf = [&](const std::string& column) -> std::optional<double> {
      const std::string& cell = events.cell(row, column);
      if (cell == "n/a") return std::nullopt;
      const auto value = asNumber<double>(cell);
      if (!value || !std::isfinite(*value))
        throw FaultError(Fault{column, fmt::format("'{}' is not a number", cell.substr(0, 40)), "a number or n/a",
                               FilePlace{file, static_cast<int>(row) + 2}});
      return value;
    };
    const auto onset = valueOf("onset"), lasts = valueOf("duration");
    if (onset && lasts && *lasts > 0) spans.push_back({*onset, *onset + *lasts});
  }
  if (spans.empty())
    throw FaultError(Fault{{},
                           fmt::format("has no event{} that lasts", trialType.empty() ? "" : " of trial_type " + trialType),
                           "at least one with onset and duration",
                           FilePlace{file}});
  return spans;
}

}  // namespace

std::vector<RecordedReach> readBidsReaches(const std::string& motion, const ReachColumns& columns) {
  std::error_code error;
  const std::string channels = beside(motion, "_channels.tsv"), events = beside(motion, "_events.tsv");
  if (!fs::exists(motion, error)) throw ResourceError(motion + ": cannot be opened");
  if (!fs::exists(channels, error)) throw FaultError(Fault{{}, "is missing", "the channels of motion.tsv beside it", FilePlace{channels}});
  const std::vector<Sample> samples = samplesOf(motion, layoutOf(channels, columns), columns);
  std::vector<ReachSpan> spans{{samples.front().time, samples.back().time}};
  if (fs::exists(events, error)) spans = reachesIn(events, columns.trialType);
  std::vector<RecordedReach> reaches;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    SeenSamples reach(spans.size() == 1 ? motion : fmt::format("{}: event {}", motion, i + 1));
    for (const Sample& sample : samples) {
      if (sample.time < spans[i].begin || sample.time > spans[i].end) continue;
      if (sample.seen) reach.add(sample.time, sample.position);
      else reach.miss();
    }
    reaches.push_back(reach.take());
  }
  return reaches;
}

}  // namespace reachlab::devices
