#pragma once
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/math/minimum_jerk.h"
#include "sim/dynamics/hand/hand_function.h"
#include "sim/dynamics/object/plant.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"
#include "tests/refusal.h"

namespace reachlab::dynamics {

inline constexpr double kTick = 1e-3;  // [s] a servo cycle

inline experiment::Experiment makeExperiment(experiment::ObjectKind kind, std::vector<double> masses, std::vector<double> stiffness,
                                             experiment::Coupling coupling = {600, 0}) {
  experiment::Experiment e;
  e.object.kind = kind;
  e.object.masses = std::move(masses);
  e.object.stiffness = std::move(stiffness);
  if (kind != experiment::ObjectKind::Parallel) e.coupling = coupling;
  return e;
}
inline experiment::Experiment makePoint(double mass = 1, experiment::Coupling coupling = {600, 0}) {
  return makeExperiment(experiment::ObjectKind::Point, {mass}, {}, coupling);
}
inline experiment::Experiment makeChain(int n, double mass, double stiffness, experiment::Coupling coupling = {600, 0}) {
  return makeExperiment(experiment::ObjectKind::Chain, std::vector<double>(n, mass), std::vector<double>(n - 1, stiffness), coupling);
}
inline experiment::Experiment onCurve(experiment::Experiment e, const std::string& x, const std::string& y, const std::string& z) {
  e.constraint.curve = {x, y, z};
  return e;
}
inline experiment::Experiment onLoop(experiment::Experiment e) {
  return onCurve(std::move(e), "0.1*cos(phi)", "0.07*sin(phi)", "0.03*sin(2*phi)");
}
inline experiment::Experiment free(experiment::Experiment e) {
  e.constraint.name = "free";
  return e;
}
/// A free body, its axes of inertia turned against its own where nothing else is given.
inline experiment::Experiment makeBody(const std::array<std::array<double, 3>, 3>& inertia = {
                                           {{0.02, 0.002, -0.004}, {0.002, 0.03, 0.001}, {-0.004, 0.001, 0.025}}}) {
  experiment::Experiment e = free(makeExperiment(experiment::ObjectKind::Body, {2}, {}));
  e.object.inertia = inertia;
  return e;
}
inline experiment::Experiment onSurface(const std::string& x, const std::string& y, const std::string& z) {
  experiment::Experiment e = makePoint();
  e.constraint.surface = {x, y, z};
  return e;
}
/// On a definition with a domain. `formulas` and `domain` are as in its file.
inline experiment::Experiment onDefinition(experiment::Experiment e, const std::string& kind, const std::string& formulas,
                                           const std::string& domain, const std::string& atEnd, bool periodic = false) {
  const bool curve = kind == "curve";
  e.constraint.name = "own";
  e.constraint.definition = fmt::format(
      R"({{"schema_version": 1, "name": "own", "kind": "{0}", "{0}": {1}, "domain": {2}, "periodic": {3}, "at_end": "{4}", "start": {5},
         "target": {6}, "sentence": "s", "source": "s"}})",
      kind, formulas, domain, periodic, atEnd, curve ? "[0]" : "[0, 0]", curve ? "[0.5]" : "[0.5, 0.5]");
  return e;
}
/// With a reach.
inline experiment::Experiment from(experiment::Experiment e, std::vector<double> start, std::vector<double> target) {
  e.task.emplace().start = std::move(start);
  e.task->target = std::move(target);
  return e;
}

/// 0.2 m along x in 1.35 s from the line's start, then held.
inline HandSample reachAt(double t) {
  const MinimumJerk law = heldMinimumJerk(t / 1.35);
  return {{-0.1 + 0.2 * law.value, 0, 0}, {0.2 * law.rate / 1.35, 0, 0}, true};
}

/// Steps of 1 ms with a hand given as a function; the first status that is not Ok, or Ok.
inline StepStatus run(Plant& plant, const HandFunction& hand, double seconds, double dt = 1e-3) {
  const int steps = static_cast<int>(std::lround(seconds / dt));
  for (int i = 0; i < steps; ++i)
    if (const StepStatus status = plant.step(makeSegment(hand, i * dt, dt), dt); status != StepStatus::Ok) return status;
  return StepStatus::Ok;
}
/// With a hand that stands.
inline StepStatus run(Plant& plant, const HandSample& hand, double seconds, double dt = 1e-3) {
  return run(
      plant, [&](double) { return hand; }, seconds, dt);
}
inline HandSample noHand(double) { return {}; }

inline std::vector<MassState> observed(const Plant& plant, const HandSample& hand = {}) {
  std::vector<MassState> masses(static_cast<std::size_t>(plant.massCount()));
  plant.observe(hand, masses);
  return masses;
}

/// A scene that nobody holds, set going.
inline Scene freeScene(const experiment::Experiment& e, const std::vector<double>& q, const std::vector<double>& rate,
                       const std::string& method = {}) {
  Scene scene = compileScene(e, {method, 1e-3, 0});
  scene.plant->setCoupled(false);
  scene.plant->place(q, rate);
  return scene;
}

/// The sentence with which the scene of an experiment is refused. Empty if it is compiled.
inline std::string refusalOfScene(const experiment::Experiment& e, const SceneOptions& options = {}) {
  return refusalOf([&] { (void)compileScene(e, options); });
}

}  // namespace reachlab::dynamics
