#pragma once
#include <numbers>

#include "sim/experiment/experiment.h"

namespace reachlab {

/// An experiment on the line of 0.2 m, from one end to the other.
inline Experiment makeLineExperiment(Object object, double couplingStiffness, double duration) {
  Experiment e;
  e.name = "test";
  e.constraint.name = "line";
  e.constraint.shape["length_m"] = 0.2;
  e.object = std::move(object);
  e.object.damping.resize(e.object.stiffness.size(), 0.0);
  if (e.object.kind != ObjectKind::Parallel) e.coupling = Coupling{couplingStiffness, 0};
  Task task;
  task.start = {0};
  task.target = {2 * std::numbers::pi};
  task.duration = duration;
  e.task = task;
  return e;
}

inline Experiment makeChain(int n, double mass, double stiffness, double duration) {
  Object object;
  object.kind = n == 1 ? ObjectKind::Point : ObjectKind::Chain;
  object.masses.assign(static_cast<size_t>(n), mass);
  object.stiffness.assign(static_cast<size_t>(n - 1), stiffness);
  return makeLineExperiment(object, stiffness, duration);
}

inline Experiment makeParallel(std::vector<double> masses, std::vector<double> stiffness, double duration) {
  Object object;
  object.kind = ObjectKind::Parallel;
  object.masses = std::move(masses);
  object.stiffness = std::move(stiffness);
  return makeLineExperiment(object, 0, duration);
}

inline Experiment dingwell() { return makeChain(1, 3, 120, 1.35); }
inline Experiment chainModerate() { return makeChain(5, 0.6, 600, 1.35); }
inline Experiment parallelPair() { return makeParallel({3, 3}, {50, 250}, 2.5); }

/// The same object along a typed curve, from one parameter to another.
inline Experiment onCurve(Experiment e, std::vector<std::string> formula, double from, double to) {
  e.constraint = {};
  e.constraint.name.clear();
  e.constraint.curve = std::move(formula);
  e.task->start = {from};
  e.task->target = {to};
  return e;
}

}  // namespace reachlab
