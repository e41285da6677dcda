#include "sim/trial/task_check.h"

#include <fmt/format.h>

#include "constraints/constraint.h"
#include "base/error.h"
#include "constraints/geometry/arc_length.h"
#include "sim/trial/protocol.h"

namespace reachlab::trial {
namespace {

constexpr double kLongTask = 60;    // [s]
constexpr double kHeavyMass = 100;  // [kg]

// Along the curve, so that a full lap is a way; the chord elsewhere. [m]
double wayOf(const constraints::Constraint& constraint, const experiment::Task& task, const ProtocolSettings& place) {
  if (constraint.kind != constraints::ConstraintKind::Curve) return norm(place.target - place.start);
  return constraints::ArcLength(constraint, task.start[0], task.target[0]).length();
}

}  // namespace

void checkTask(const experiment::Experiment& experiment, const std::string& file) {
  if (!experiment.task) throw UsageError(file + ": task: is missing, and a run needs one; allowed: { start, target, … }");
  const constraints::Constraint constraint = constraints::makeConstraint(experiment.constraint);
  const ProtocolSettings place = [&] {
    try {
      return makeProtocolSettings(experiment, constraint);
    } catch (const UsageError& fault) {
      throw UsageError(file + ": " + fault.what());
    }
  }();
  const bool flat = constraint.kind == constraints::ConstraintKind::Free || constraint.straight;
  if (experiment.task->start == experiment.task->target || (flat && place.start == place.target))
    throw UsageError(file + ": task.target: start and target are the same place; allowed: two places");
}

std::vector<std::string> implausibleNumbers(const experiment::Experiment& experiment, const std::string& file) {
  std::vector<std::string> found;
  const std::vector<double>& masses = experiment.object.masses;
  for (std::size_t i = 0; i < masses.size(); ++i)
    if (masses[i] > kHeavyMass)
      found.push_back(fmt::format("{}: object.masses_kg[{}]: is {} kg; more than {} kg is hardly meant", file, i, masses[i], kHeavyMass));
  if (!experiment.task) return found;
  const experiment::Task& task = *experiment.task;
  if (task.duration > kLongTask)
    found.push_back(fmt::format("{}: task.duration_s: is {} s; more than {} s is hardly meant", file, task.duration, kLongTask));
  const constraints::Constraint constraint = constraints::makeConstraint(experiment.constraint);
  const double way = wayOf(constraint, task, makeProtocolSettings(experiment, constraint));
  if (task.tolerance.position > way)
    found.push_back(fmt::format("{}: task.tolerance.position_m: is {} m, more than the way of {:.4g} m from start to target", file,
                                task.tolerance.position, way));
  return found;
}

}  // namespace reachlab::trial
