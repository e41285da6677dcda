#include "cli/hand_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>

#include "cli/spline.h"
#include "constraints/geometry/arc_length.h"
#include "base/error.h"
#include "base/json_tree.h"

namespace reachlab::cli {
namespace {

const experiment::Task& requireTask(const experiment::Experiment& experiment, const std::string& name) {
  if (!experiment.task) throw RefusedError("--hand " + name + " needs the experiment's task (start, target, duration_s)");
  return *experiment.task;
}

Vec3 placeOf(const constraints::Constraint& c, const std::vector<double>& q, const char* what) {
  const std::size_t wanted = c.kind == constraints::ConstraintKind::Free ? 3 : static_cast<std::size_t>(c.parameterCount());
  if (q.size() != wanted) throw RefusedError(fmt::format("task.{} has {} numbers where the constraint has {}", what, q.size(), wanted));
  for (std::size_t k = 0; k < q.size(); ++k)
    if (c.kind != constraints::ConstraintKind::Free && !c.domain[k].periodic && (q[k] < c.domain[k].lo || q[k] > c.domain[k].hi))
      throw RefusedError(fmt::format("task.{} {} lies off the constraint's domain, {} to {}", what, q[k], c.domain[k].lo, c.domain[k].hi));
  const Vec3 r = c.kind == constraints::ConstraintKind::Free    ? Vec3{q[0], q[1], q[2]}
                 : c.kind == constraints::ConstraintKind::Curve ? constraints::evaluate(c.curve, q[0]).r
                                                                : constraints::evaluate(c.surface, q[0], q[1]).r;
  if (!isFinite(r)) throw RefusedError(fmt::format("the constraint is not finite at task.{}", what));
  return r;
}

HandLaw straightReach(const experiment::Experiment& experiment, const constraints::Constraint& c) {
  const experiment::Task& task = requireTask(experiment, "min-jerk");
  const Vec3 start = placeOf(c, task.start, "start"), chord = placeOf(c, task.target, "target") - start;
  const double duration = task.duration;
  if (!(norm(chord) > 1e-12))
    throw RefusedError("--hand min-jerk: start and target are the same place, so there is no chord to follow; use min-jerk-along or hold");
  return {[start, chord, duration](double t) {
            const dynamics::MinJerk law = dynamics::minJerk(t / duration);
            return dynamics::HandSample{start + law.s * chord, (law.rate / duration) * chord, true};
          },
          {},
          {0, duration}};
}

/// Along the curve the arc length follows the law.
HandLaw reachAlong(const experiment::Experiment& experiment, const constraints::Constraint& c) {
  const experiment::Task& task = requireTask(experiment, "min-jerk-along");
  placeOf(c, task.start, "start");
  placeOf(c, task.target, "target");
  if (c.kind == constraints::ConstraintKind::Surface)
    throw RefusedError("--hand min-jerk-along follows a curve; on a surface use min-jerk");
  if (c.kind == constraints::ConstraintKind::Free) return straightReach(experiment, c);
  const double from = task.start[0], to = task.target[0], duration = task.duration;
  const auto way = std::make_shared<const constraints::ArcLength>(c, from, to);
  if (!(way->length() > 1e-12)) throw RefusedError("--hand min-jerk-along: start and target are the same place on the curve");
  const double direction = to < from ? -1 : 1;
  return {[c, way, direction, duration](double t) {
            const dynamics::MinJerk law = dynamics::minJerk(t / duration);
            const constraints::CurvePoint p = constraints::evaluate(c.curve, way->parameterAt(law.s * way->length()));
            const double speed = norm(p.rPhi);
            const Vec3 v = speed > 0 ? (direction * law.rate / duration * way->length() / speed) * p.rPhi : Vec3{};
            return dynamics::HandSample{p.r, v, true};
          },
          {},
          {0, duration}};
}

double numberIn(const std::string& text, const std::string& file, int line, const char* column) {
  double value = 0;
  const char* begin = text.data();
  while (*begin == ' ') ++begin;
  const auto [end, fault] = std::from_chars(begin, text.data() + text.size(), value);
  const std::string rest(end, text.data() + text.size());
  if (fault != std::errc() || rest.find_first_not_of(" \r") != std::string::npos || !std::isfinite(value))
    throw UsageError(fmt::format("{}:{}: {}: '{}' is not a number; allowed: a finite number", file, line, column, text.substr(0, 40)));
  return value;
}

HandLaw sampledHand(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw UsageError(file + ": cannot be read; allowed for --hand: none, hold, min-jerk, min-jerk-along, or a CSV file");
  std::istringstream in(readTextFile(file));
  std::string line;
  int number = 1;
  std::array<int, 4> place{-1, -1, -1, -1};
  constexpr std::array<const char*, 4> kColumns{"time_s", "x_m", "y_m", "z_m"};
  const auto cells = [](const std::string& text) {
    std::vector<std::string> result;
    std::stringstream stream(text);
    for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
    return result;
  };
  if (std::getline(in, line)) {
    if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const auto names = cells(line);
    for (std::size_t i = 0; i < names.size(); ++i)
      for (int k = 0; k < 4; ++k)
        if (names[i] == kColumns[k]) place[k] = static_cast<int>(i);
  }
  for (int k = 0; k < 4; ++k)
    if (place[k] < 0)
      throw UsageError(fmt::format("{}:1: {}: column is missing; allowed: a header with time_s,x_m,y_m,z_m", file, kColumns[k]));
  std::array<std::vector<double>, 4> columns;
  while (std::getline(in, line)) {
    ++number;
    if (line.find_first_not_of(" \r") == std::string::npos) continue;
    const auto values = cells(line);
    for (int k = 0; k < 4; ++k) {
      if (place[k] >= static_cast<int>(values.size()))
        throw UsageError(fmt::format("{}:{}: {}: is missing; allowed: a finite number", file, number, kColumns[k]));
      columns[k].push_back(numberIn(values[place[k]], file, number, kColumns[k]));
    }
    const auto& t = columns[0];
    if (t.size() > 1 && !(t.back() > t[t.size() - 2]))
      throw UsageError(fmt::format("{}:{}: time_s: does not increase; allowed: increasing times", file, number));
  }
  if (columns[0].empty()) throw UsageError(file + ": has no samples; allowed: at least one row");
  const auto splines = std::make_shared<std::array<Spline, 3>>(
      std::array{Spline(columns[0], columns[1]), Spline(columns[0], columns[2]), Spline(columns[0], columns[3])});
  const auto at = [splines](double t) {
    const auto x = (*splines)[0].at(t), y = (*splines)[1].at(t), z = (*splines)[2].at(t);
    return dynamics::HandSample{{x.x, y.x, z.x}, {x.rate, y.rate, z.rate}, true};
  };
  const double first = columns[0].front(), last = columns[0].back();
  return {at,
          [at, first, last](double t, double within) {
            if (first < within && within < last) return at(std::clamp(t, first, last));
            dynamics::HandSample rest = at(within <= first ? first : last);
            rest.velocity = {};
            return rest;
          },
          columns[0]};
}

}  // namespace

HandLaw makeHandLaw(const std::string& name, const experiment::Experiment& experiment, const constraints::Constraint& constraint) {
  if (name == "none") return {[](double) { return dynamics::HandSample{}; }};
  if (name == "min-jerk") return straightReach(experiment, constraint);
  if (name == "min-jerk-along") return reachAlong(experiment, constraint);
  if (name == "hold") {
    const Vec3 start = placeOf(constraint, requireTask(experiment, name).start, "start");
    return {[start](double) { return dynamics::HandSample{start, {}, true}; }};
  }
  return sampledHand(name);
}

}  // namespace reachlab::cli
