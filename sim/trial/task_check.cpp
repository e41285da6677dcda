#include "sim/trial/task_check.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/json/json_reader.h"
#include "base/math/eigen_solvers.h"
#include "base/math/minimum_jerk.h"
#include "constraints/constraint.h"
#include "constraints/geometry/arc_length.h"
#include "constraints/geometry/task_path.h"
#include "constraints/regularity/analysis.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/protocol.h"

namespace reachlab::trial {
namespace {

constexpr double kLongTask = 60;    // [s]
constexpr double kHeavyMass = 100;  // [kg]
constexpr double kFastHand = 10;    // [m/s], above a boxer's punch of 9.1 m/s (Walilko, Viano & Bir 2005)
constexpr double kManyTurns = 1.5;  // a full lap is a reach, and may end a little behind its start

// Along the curve, so that a full lap is a way; the chord elsewhere. A lap on a surface has no chord: it counts as infinitely long. [m]
double wayOf(const constraints::Constraint& constraint, const experiment::Task& task, const ProtocolSettings& place) {
  constexpr double kSamePlace = 1e-9;  // [m]
  const double chord = norm(place.target - place.start);
  if (constraint.kind == constraints::ConstraintKind::Surface && chord < kSamePlace) return std::numeric_limits<double>::infinity();
  if (constraint.kind != constraints::ConstraintKind::Curve) return chord;
  return constraints::ArcLength(constraint, task.start[0], task.target[0]).length();
}

/// The part of a domain in which a mass may pass on its way: all of it, or of one without an end `ways` times the longest way of a parameter on
/// either side.
constraints::Domain nearTheWay(const constraints::Domain& domain, const experiment::Task& task, std::size_t parameter, double ways) {
  double longest = 0;
  for (std::size_t k = 0; k < task.start.size(); ++k) longest = std::max(longest, std::abs(task.target[k] - task.start[k]));
  const auto [least, most] = std::minmax(task.start[parameter], task.target[parameter]);
  constraints::Domain near = domain;
  if (!std::isfinite(near.lo)) near.lo = least - ways * longest;
  if (!std::isfinite(near.hi)) near.hi = most + ways * longest;
  return near;
}

/// False if every point of the constraint near the way is farther from the place than the radius. The search looks at a grid of points, and
/// doubts in favour of the place between them.
bool canBePassed(const constraints::Constraint& c, const experiment::Task& task, const ProtocolSettings& settings, const Vec3& place) {
  const double radius = settings.viaRadius, way = norm(settings.target - settings.start);
  constexpr double kMostWays = 100;  // where start and target are nearly one place
  const double ways = way > 0 ? std::min(kMostWays, 4 * (1 + norm(place - settings.start) / way)) : kMostWays;
  const auto isNear = [&](const Vec3& r, double spacing) { return !(norm(r - place) > radius + spacing); };
  if (c.kind == constraints::ConstraintKind::Free) return true;
  const bool curve = c.kind == constraints::ConstraintKind::Curve;
  const constraints::Domain first = nearTheWay(c.domain[0], task, 0, ways),
                            second = curve ? c.domain[1] : nearTheWay(c.domain[1], task, 1, ways);
  const int cells = curve ? 4000 : 200;
  const double step = (first.hi - first.lo) / cells, across = (second.hi - second.lo) / cells;
  for (int i = 0; i <= cells; ++i) {
    if (curve) {
      const constraints::CurvePoint p = evaluate(c.curve, first.lo + i * step);
      if (isNear(p.r, norm(p.rPhi) * step)) return true;
      continue;
    }
    for (int k = 0; k <= cells; ++k) {
      const constraints::SurfacePoint p = evaluate(c.surface, first.lo + i * step, second.lo + k * across);
      if (isNear(p.r, norm(p.rU) * step + norm(p.rV) * across)) return true;
    }
  }
  return false;
}

/// True if the straight way in the parameters of a surface is one place, as between two longitudes of a pole.
bool isOnePlace(const constraints::Constraint& c, const experiment::Task& task) {
  if (c.kind != constraints::ConstraintKind::Surface) return false;
  constexpr int kLooks = 64;
  constexpr double kSame = 1e-9;  // [m]
  const Vec3 start = evaluate(c.surface, task.start[0], task.start[1]).r;
  for (int i = 1; i <= kLooks; ++i) {
    const double s = static_cast<double>(i) / kLooks;
    const auto at = [&](std::size_t k) { return task.start[k] + s * (task.target[k] - task.start[k]); };
    if (norm(evaluate(c.surface, at(0), at(1)).r - start) > kSame) return false;
  }
  return true;
}

/// Some surfaces are left by their parameters and not by their places, as a sphere is at v beyond its pole.
bool goesOnBehind(const constraints::Constraint& constraint, std::size_t parameter, double target) {
  if (constraint.kind != constraints::ConstraintKind::Surface) return false;
  constexpr double kSame = 1e-9;  // of the end's size
  const double end = target > constraint.domain[parameter].hi ? constraint.domain[parameter].hi : constraint.domain[parameter].lo;
  for (const constraints::DegeneratePlace& place : constraints::findDegeneratePlaces(constraint))
    if (place.kind == constraints::DegenerateKind::Pole && place.fixed == static_cast<int>(parameter) &&
        std::abs((parameter == 0 ? place.u : place.v) - end) <= kSame * (1 + std::abs(end)))
      return true;
  return false;
}

}  // namespace

std::vector<Fault> taskProblems(const experiment::CompiledExperiment& compiled) {
  const experiment::Experiment& experiment = compiled.experiment();
  if (!experiment.task) return {{"task", "is missing, and a run needs one", "{ start, target, … }"}};
  const constraints::Constraint& constraint = compiled.constraint();
  ProtocolSettings place;
  try {
    place = makeProtocolSettings(experiment, constraint);
  } catch (const FaultError& error) {
    return error.faults;
  }
  const bool flat = constraint.kind == constraints::ConstraintKind::Free || constraint.straight;
  if (experiment.task->start == experiment.task->target || (flat && place.start == place.target) ||
      isOnePlace(constraint, *experiment.task))
    return {constraints::samePlaceFault()};
  std::vector<Fault> found;
  for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.parameterCount()); ++k) {
    const constraints::Domain& domain = constraint.domain[k];
    const double target = experiment.task->target[k];
    if (domain.has(target) || goesOnBehind(constraint, k, target)) continue;
    found.push_back(
        {fmt::format("task.target[{}]", k),
         fmt::format("is {}, beyond an end of the {}", target, constraint.kind == constraints::ConstraintKind::Curve ? "curve" : "surface"),
         fmt::format("{} to {}", domain.lo, domain.hi)});
  }
  for (std::size_t i = 0; i < place.via.size(); ++i)
    if (!canBePassed(constraint, *experiment.task, place, place.via[i]))
      found.push_back({fmt::format("task.via_m[{}]", i), "is farther from the constraint than via_radius_m, so that no mass can pass it",
                       "a place on the constraint"});
  return found;
}

void checkTask(const experiment::CompiledExperiment& experiment, const std::string& file) {
  std::vector<Fault> faults = atTheirPlaces(taskProblems(experiment), experiment.experiment().text, file);
  if (!faults.empty()) throw FaultError(std::move(faults));
}

namespace {

/// Whether x . K x is negative for some x: an eigenvalue of the symmetric part is.
bool pushesAway(const experiment::SquareMatrix<3>& k) {
  Eigen::MatrixXd symmetric(3, 3);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) symmetric(static_cast<int>(i), static_cast<int>(j)) = 0.5 * (k[i][j] + k[j][i]);
  constexpr double kRounding = 1e-12;
  return symmetricEigenvalues(symmetric).minCoeff() < -kRounding * symmetric.norm();
}

/// A pulse that comes after the last moment of a trial, or farther from the start than a hand goes: `farthest` [m], not known on a bent way.
void findLatePulses(const experiment::Environment& environment, const experiment::Task& task, std::optional<double> farthest,
                    std::vector<Fault>& found) {
  for (std::size_t i = 0; i < environment.size(); ++i) {
    const auto* pulse = std::get_if<experiment::PulseForce>(&environment[i].law);
    if (pulse == nullptr) continue;
    const std::string key = fmt::format("environment[{}].at.", i);
    if (const double last = task.duration + task.tolerance.time; pulse->at.onset && *pulse->at.onset >= last)
      found.push_back(
          {key + "onset_s", fmt::format("is {} s, and no movement lasts longer than {} s: the pulse never comes", *pulse->at.onset, last)});
    if (pulse->at.distance && farthest && *pulse->at.distance > *farthest + task.tolerance.position)
      found.push_back(
          {key + "distance_m", fmt::format("is {} m, and the hand goes {:.4g} m away: the pulse comes only to a hand that misses",
                                           *pulse->at.distance, *farthest)});
  }
}

void findFieldsWithoutBound(const experiment::Environment& environment, std::vector<Fault>& found) {
  for (std::size_t i = 0; i < environment.size(); ++i)
    if (const auto* elastic = std::get_if<experiment::ElasticForce>(&environment[i].law); elastic != nullptr && pushesAway(elastic->matrix))
      found.push_back({fmt::format("environment[{}].matrix_n_per_m", i),
                       "pushes the hand away from the centre, the farther the more; no device can hold such a field without bound",
                       "a matrix whose symmetric part has no negative eigenvalue"});
}

}  // namespace

std::vector<Fault> implausibleNumbers(const experiment::CompiledExperiment& compiled) {
  const experiment::Experiment& experiment = compiled.experiment();
  std::vector<Fault> found;
  const std::vector<double>& masses = experiment.object.masses;
  for (std::size_t i = 0; i < masses.size(); ++i)
    if (masses[i] > kHeavyMass)
      found.push_back(
          {fmt::format("object.masses_kg[{}]", i), fmt::format("is {} kg; more than {} kg is hardly meant", masses[i], kHeavyMass)});
  findFieldsWithoutBound(experiment.environment, found);
  if (!experiment.task) return found;
  const experiment::Task& task = *experiment.task;
  const auto findSlack = [&](const std::string& key, double stiffness) {
    if (stiffness == 0) found.push_back({key, "is 0 N/m: the hand cannot bring to rest what is behind this spring"});
  };
  if (experiment.coupling) findSlack("coupling.stiffness_n_per_m", experiment.coupling->stiffness);
  for (std::size_t i = 0; i < experiment.object.stiffness.size(); ++i)
    findSlack(fmt::format("object.stiffness_n_per_m[{}]", i), experiment.object.stiffness[i]);
  if (task.duration > kLongTask)
    found.push_back({"task.duration_s", fmt::format("is {} s; more than {} s is hardly meant", task.duration, kLongTask)});
  for (std::size_t i = 0; i < task.target.size() && i < 2; ++i) {
    const constraints::Domain& domain = compiled.constraint().domain[i];
    const double turns = std::abs(task.target[i] - task.start[i]) / (domain.hi - domain.lo);
    if (domain.periodic && turns > kManyTurns)
      found.push_back(
          {fmt::format("task.target[{}]", i), fmt::format("is {:.3g} turns from the start; more than one turn is hardly meant", turns)});
  }
  const ProtocolSettings settings = makeProtocolSettings(experiment, compiled.constraint());
  const double way = wayOf(compiled.constraint(), task, settings);
  if (const double peak = way * minimumJerkRate(0.5) / task.duration; std::isfinite(peak) && peak > kFastHand)
    found.push_back(
        {"task.duration_s", fmt::format("is {} s for a way of {:.3g} m, which needs {:.3g} m/s; more than {} m/s is hardly meant",
                                        task.duration, way, peak, kFastHand)});
  std::optional<double> farthest;
  if (compiled.constraint().kind == constraints::ConstraintKind::Free || compiled.constraint().straight) {
    farthest = norm(settings.target - settings.start);
    for (const Vec3& via : settings.via) farthest = std::max(*farthest, norm(via - settings.start));
  }
  findLatePulses(experiment.environment, task, farthest, found);
  if (task.tolerance.position > way)
    found.push_back({"task.tolerance.position_m",
                     fmt::format("is {} m, more than the way of {:.4g} m from start to target", task.tolerance.position, way)});
  if (task.onset >= way)
    found.push_back({"task.onset_m", fmt::format("is {} m, no less than the way of {:.4g} m from start to target", task.onset, way)});
  return found;
}

}  // namespace reachlab::trial
