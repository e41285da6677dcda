#include "cli/commands/hand_laws.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/fault.h"
#include "base/math/cubic_spline.h"
#include "base/math/minimum_jerk.h"
#include "base/text_file.h"
#include "constraints/geometry/arc_length.h"
#include "constraints/geometry/task_path.h"
#include "devices/replay/recorded_reach.h"
#include "sim/experiment/experiment.h"

namespace reachlab::cli {
namespace {

const experiment::Task& requireTask(const experiment::Experiment& experiment, const char* name) {
  if (!experiment.task) throw RefusedError(fmt::format("--hand {} needs the experiment's task (start, target, duration_s)", name));
  return *experiment.task;
}

Vec3 placeOf(const constraints::Constraint& c, const std::vector<double>& q, const char* what) {
  const std::size_t wanted = c.kind == constraints::ConstraintKind::Free ? 3 : static_cast<std::size_t>(c.parameterCount());
  if (q.size() != wanted) throw RefusedError(fmt::format("task.{} has {} numbers where the constraint has {}", what, q.size(), wanted));
  for (std::size_t k = 0; k < q.size(); ++k)
    if (c.kind != constraints::ConstraintKind::Free && !c.domain[k].periodic && (q[k] < c.domain[k].lo || q[k] > c.domain[k].hi))
      throw RefusedError(fmt::format("task.{} {} lies off the constraint's domain, {} to {}", what, q[k], c.domain[k].lo, c.domain[k].hi));
  const Vec3 r = constraints::placeOn(c, q);
  if (!isFinite(r)) throw RefusedError(fmt::format("the constraint is not finite at task.{}", what));
  return r;
}

HandLaw straightReach(const experiment::Experiment& experiment, const constraints::Constraint& c) {
  const experiment::Task& task = requireTask(experiment, "min-jerk");
  const Vec3 start = placeOf(c, task.start, "start"), chord = placeOf(c, task.target, "target") - start;
  const double duration = task.duration;
  if (!(norm(chord) > 1e-12))
    throw RefusedError(
        "--hand min-jerk: start and target are the same position, so there is no chord to follow; use min-jerk-along or hold");
  return {[start, chord, duration](double t) {
            const MinimumJerk law = heldMinimumJerk(t / duration);
            return dynamics::HandSample{start + law.value * chord, (law.rate / duration) * chord, true};
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
  if (!(way->length() > 1e-12)) throw RefusedError("--hand min-jerk-along: start and target are the same position on the curve; use hold");
  const double direction = to < from ? -1 : 1;
  return {[c, way, direction, duration](double t) {
            const MinimumJerk law = heldMinimumJerk(t / duration);
            const constraints::CurvePoint p = constraints::evaluate(c.curve, way->parameterAt(law.value * way->length()));
            const double speed = norm(p.rPhi);
            const Vec3 v = speed > 0 ? (direction * law.rate / duration * way->length() / speed) * p.rPhi : Vec3{};
            return dynamics::HandSample{p.r, v, true};
          },
          {},
          {0, duration}};
}

HandLaw sampledHand(const std::string& file) {
  if (!isThere(file)) throw FaultError(Fault{"--hand", file + " cannot be read", "none, hold, min-jerk, min-jerk-along, or a CSV file"});
  const devices::RecordedReach reach = devices::readReach(file);
  const auto spline = std::make_shared<const CubicSpline>(reach.time, reach.position, SplineEnds::NotAKnot);
  const auto at = [spline](double t) {
    const auto [position, velocity] = spline->at(t);
    return dynamics::HandSample{position, velocity, true};
  };
  const double first = reach.time.front(), last = reach.time.back();
  return {at,
          [at, first, last](double t, double within) {
            if (first < within && within < last) return at(std::clamp(t, first, last));
            dynamics::HandSample rest = at(within <= first ? first : last);
            rest.velocity = {};
            return rest;
          },
          reach.time};
}

}  // namespace

HandLaw makeHandLaw(const std::string& name, const experiment::Experiment& experiment, const constraints::Constraint& constraint) {
  if (name == "none") return {[](double) { return dynamics::HandSample{}; }};
  if (name == "min-jerk") return straightReach(experiment, constraint);
  if (name == "min-jerk-along") return reachAlong(experiment, constraint);
  if (name == "hold") {
    const Vec3 start = placeOf(constraint, requireTask(experiment, "hold").start, "start");
    return {[start](double) { return dynamics::HandSample{start, {}, true}; }};
  }
  return sampledHand(name);
}

}  // namespace reachlab::cli
