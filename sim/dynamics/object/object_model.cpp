#include "sim/dynamics/object/object_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "sim/experiment/experiment.h"

namespace reachlab::dynamics {
namespace {

void requireUsable(const std::vector<double>& values, const char* what, bool positive) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || values[i] < 0 || (positive && values[i] == 0))
      throw RefusedError(std::string(what) + " of " + (positive ? "mass " : "spring ") + std::to_string(i + 1) + " is " +
                         std::to_string(values[i]) +
                         (positive ? ": a mass must be positive, or it has no equation of motion" : ": must be 0 or more"));
}

}  // namespace

ObjectModel makeObjectModel(const experiment::Experiment& experiment) {
  const experiment::Object& object = experiment.object;
  const experiment::Coupling coupling = experiment.coupling.value_or(experiment::Coupling{});
  ObjectModel model;
  model.kind = object.kind;
  model.mass = object.masses;
  model.viscosity = object.viscosity;
  model.gravity = object.gravity;
  const std::size_t n = model.mass.size();
  if (n == 0) throw RefusedError("the object has no mass: give masses_kg");
  if (n > static_cast<std::size_t>(experiment::kMaxMasses))
    throw RefusedError("more than " + std::to_string(experiment::kMaxMasses) + " masses");
  const bool parallel = object.kind == experiment::ObjectKind::Parallel;
  std::vector<double> damping = object.damping;
  damping.resize(object.stiffness.size(), 0.0);
  if (object.stiffness.size() != (parallel ? n : n - 1))
    throw RefusedError("stiffness_n_per_m has " + std::to_string(object.stiffness.size()) + " numbers where " +
                       std::to_string(parallel ? n : n - 1) + " are needed");
  requireUsable(model.mass, "the mass", true);
  requireUsable(object.stiffness, "the stiffness", false);
  requireUsable(damping, "the damping", false);
  requireUsable({coupling.stiffness, coupling.damping}, "the coupling", false);
  requireUsable({object.viscosity}, "the viscosity", false);
  if (!isFinite(object.gravity)) throw RefusedError("gravity_m_per_s2 is not finite");
  if (parallel) {
    model.handStiffness = object.stiffness;
    model.handDamping = damping;
  } else {
    model.stiffness = object.stiffness;
    model.damping = damping;
    model.handStiffness.assign(n, 0.0);
    model.handDamping.assign(n, 0.0);
    model.handStiffness[0] = coupling.stiffness;
    model.handDamping[0] = coupling.damping;
  }
  if (object.kind == experiment::ObjectKind::Body) {
    model.inertia = object.inertia;
    model.hands = handSpringsOf(experiment);
  }
  if (experiment.hands.empty()) return model;
  model.handStiffness.assign(n, 0.0);
  model.handDamping.assign(n, 0.0);
  for (const HandSprings& hand : handSpringsOf(experiment)) {
    requireUsable(hand.stiffness, "the hand's stiffness", false);
    requireUsable(hand.damping, "the hand's damping", false);
    for (std::size_t i = 0; i < n; ++i) {
      model.handStiffness[i] += hand.stiffness[i];
      model.handDamping[i] += hand.damping[i];
    }
  }
  return model;
}

double boundFastestMode(const ObjectModel& model) {
  double fastest = 0;
  for (int i = 0; i < model.count(); ++i) {
    const bool springs = !model.stiffness.empty();
    const double k = model.handStiffness[i] +
                     2 * ((springs && i > 0 ? model.stiffness[i - 1] : 0) + (springs && i + 1 < model.count() ? model.stiffness[i] : 0));
    const double b = model.viscosity + model.handDamping[i] +
                     2 * ((springs && i > 0 ? model.damping[i - 1] : 0) + (springs && i + 1 < model.count() ? model.damping[i] : 0));
    fastest = std::max(fastest, std::max(std::sqrt(k / model.mass[i]), b / model.mass[i]));
  }
  return fastest;
}

}  // namespace reachlab::dynamics
