#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "base/c3d_file.h"
#include "base/error.h"
#include "base/fault.h"
#include "base/text_file.h"
#include "devices/replay/reach_checks.h"

namespace reachlab::devices {
namespace {

std::size_t pointAsked(const C3dFile& c3d, const std::string& file, const std::string& point) {
  if (point.empty() && c3d.points.size() == 1) return 0;
  std::vector<std::string> names;
  for (const C3dLabel& label : c3d.points) names.push_back(label.name);
  const auto at = std::find(names.begin(), names.end(), point);
  if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  refuse({file}, point.empty() ? fmt::format("has {} points, and none is named", names.size()) : "has no point " + point,
         fmt::format("point= with one of {}", fmt::join(names, ", ")));
}

// The reach in a trial: from the event `onset` to the event `end`, as events.tsv of the same trial has it. Without either it is the whole file.
// A file with an `end` alone is a trial in which the hand stayed at the start: every trial of ours has an `end`.
struct Span {
  double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();  // [s] since the first frame
};

std::optional<Span> reachIn(const C3dFile& c3d) {
  const auto timeOf = [&](const char* label) -> std::optional<double> {
    const auto at = std::find_if(c3d.events.begin(), c3d.events.end(), [&](const C3dEvent& event) { return event.label == label; });
    if (at == c3d.events.end()) return std::nullopt;
    return at->time;
  };
  const auto onset = timeOf("onset"), end = timeOf("end");
  if (end && !onset) return std::nullopt;
  if (!end || !(*end > *onset)) return Span{};
  const double rounding = 1e-4;  // [s] times are single precision
  return Span{*onset - rounding, *end + rounding};
}

}  // namespace

std::optional<RecordedReach> readC3dReach(const std::string& file, const ReachColumns& columns) {
  if (!isThere(file)) throw ResourceError(file + ": cannot be opened");
  const C3dFile c3d = readC3d(readTextFile(file), file);
  const std::size_t point = pointAsked(c3d, file, columns.point);
  const double unit = metresOf(columns.unit.empty() ? c3d.pointUnit : columns.unit, {file});
  const std::optional<Span> reach = reachIn(c3d);
  if (!reach) return std::nullopt;
  SeenSamples samples(file);
  for (std::size_t frame = 0; frame < c3d.frames; ++frame) {
    const std::size_t at = frame * c3d.points.size() + point;
    const double time = static_cast<double>(frame) / c3d.rate;
    if (time < reach->begin || time > reach->end || c3d.seen[at] == 0) continue;
    const auto metres = [&](std::size_t axis) { return unit * static_cast<double>(c3d.places[3 * at + axis]); };
    samples.add(time, {metres(0), metres(1), metres(2)});
  }
  return samples.take();
}

}  // namespace reachlab::devices
