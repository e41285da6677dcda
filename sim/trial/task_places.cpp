#include "sim/trial/task_places.h"

#include <fmt/format.h>

#include <cmath>

#include "constraints/regularity/places.h"
#include "constraints/regularity/surface_branches.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/protocol.h"

namespace reachlab::trial {
namespace {

constexpr double kAcross = 1e-6;  // cosine below which the pull along the constraint is rounding and a hand's tremor

void addPlaces(const constraints::Constraint& c, const experiment::Task& task, std::vector<Fault>& found) {
  if (c.kind == constraints::ConstraintKind::Curve) {
    for (const constraints::Place& place :
         constraints::placesBetween(constraints::computeRegularity(c, task.start[0]), task.start[0], task.target[0]))
      found.push_back({"task", fmt::format("between start and target: {} ({})", describe(place, c.kind),
                                           constraints::isPassed(place.kind) ? "passed with the speed along the curve" : "never crossed")});
    return;
  }
  const auto branches = constraints::computeBranches(c);
  if (branches->smooth()) return;
  const auto sides = [&](double share) {
    return branches->at(task.start[0] + share * (task.target[0] - task.start[0]), task.start[1] + share * (task.target[1] - task.start[1]));
  };
  constexpr int kLooks = 400;
  for (std::size_t k = 0; k < branches->lines.size(); ++k) {
    const constraints::SurfaceBranches::Line& line = branches->lines[k];
    for (int i = 1; i <= kLooks; ++i) {
      const double before = sides((i - 1) / double{kLooks})[k].value, after = sides(i / double{kLooks})[k].value;
      if (before * after > 0) continue;
      found.push_back(
          {"task", fmt::format("the straight way in u and v from start to target meets a {}: {} ({})", nameOf(line.kind), line.because,
                               constraints::isPassed(line.kind) ? "passed as a geodesic passes a crease" : "never crossed")});
      break;
    }
  }
}

/// The chord from start to target has no part along the constraint at the start, and nothing else pulls there.
void addTie(const experiment::Experiment& experiment, const constraints::Constraint& c, std::vector<Fault>& found) {
  const experiment::Task& task = *experiment.task;
  Vec3 chord;
  std::array<Vec3, 2> along;
  if (c.kind == constraints::ConstraintKind::Curve) {
    const constraints::CurvePoint start = evaluate(c.curve, task.start[0]);
    chord = evaluate(c.curve, task.target[0]).r - start.r;
    along[0] = start.rPhi;
  } else {
    const constraints::SurfacePoint start = evaluate(c.surface, task.start[0], task.start[1]);
    chord = evaluate(c.surface, task.target[0], task.target[1]).r - start.r;
    along = {start.rU, start.rV};
  }
  if (!(norm(chord) > 1e-9)) return;
  for (const Vec3& tangent : along) {
    const double size = norm(tangent);
    if (!(size > 0)) continue;
    if (std::abs(dot(tangent, chord)) > kAcross * size * norm(chord)) return;
    if (std::abs(dot(tangent, experiment.object.gravity)) > kAcross * size) return;
  }
  found.push_back(
      {"task",
       fmt::format("the chord from start to target stands at right angles to the {} at the start: a hand that goes straight to "
                   "the target pulls the mass to neither side, and rounding decides which way it leaves; choose another start or target",
                   c.kind == constraints::ConstraintKind::Curve ? "curve" : "surface")});
}

}  // namespace

Vec3 startOf(const experiment::CompiledExperiment& experiment) {
  if (!experiment.experiment().task) return {};
  return makeProtocolSettings(experiment.experiment(), experiment.constraint()).start;
}

std::vector<Fault> describeWay(const experiment::CompiledExperiment& compiled) {
  std::vector<Fault> found;
  const experiment::Experiment& experiment = compiled.experiment();
  const constraints::Constraint& c = compiled.constraint();
  if (!experiment.task || c.kind == constraints::ConstraintKind::Free) return found;
  addPlaces(c, *experiment.task, found);
  addTie(experiment, c, found);
  return found;
}

}  // namespace reachlab::trial
