#pragma once
#include <functional>
#include <numbers>
#include <span>
#include <utility>

#include "sim/experiment/experiment.h"
#include "sim/predict/predict.h"

namespace reachlab::predict {

inline constexpr double kProfile = 1e-8;  // of the peak: what the number of unknowns is chosen for

/// An experiment on the line of 0.2 m, from one end to the other.
inline experiment::Experiment makeLineExperiment(experiment::Object object, double couplingStiffness, double duration) {
  experiment::Experiment e;
  e.name = "test";
  e.constraint.name = "line";
  e.constraint.shape["length_m"] = 0.2;
  e.object = std::move(object);
  e.object.damping.resize(e.object.stiffness.size(), 0.0);
  if (e.object.kind != experiment::ObjectKind::Parallel) e.coupling = experiment::Coupling{couplingStiffness, 0};
  experiment::Task task;
  task.start = {0};
  task.target = {2 * std::numbers::pi};
  task.duration = duration;
  e.task = task;
  return e;
}

inline experiment::Experiment makeChain(int n, double mass, double stiffness, double duration) {
  experiment::Object object;
  object.kind = n == 1 ? experiment::ObjectKind::Point : experiment::ObjectKind::Chain;
  object.masses.assign(static_cast<size_t>(n), mass);
  object.stiffness.assign(static_cast<size_t>(n - 1), stiffness);
  return makeLineExperiment(object, stiffness, duration);
}

inline experiment::Experiment makeParallel(std::vector<double> masses, std::vector<double> stiffness, double duration) {
  experiment::Object object;
  object.kind = experiment::ObjectKind::Parallel;
  object.masses = std::move(masses);
  object.stiffness = std::move(stiffness);
  return makeLineExperiment(object, 0, duration);
}

inline experiment::Experiment dingwell() { return makeChain(1, 3, 120, 1.35); }
inline experiment::Experiment chainModerate() { return makeChain(5, 0.6, 600, 1.35); }
inline experiment::Experiment parallelPair() { return makeParallel({3, 3}, {50, 250}, 2.5); }

/// The same object along a typed curve, from one parameter to another.
inline experiment::Experiment onCurve(experiment::Experiment e, std::vector<std::string> formula, double from, double to) {
  e.constraint = {};
  e.constraint.name.clear();
  e.constraint.curve = std::move(formula);
  e.task->start = {from};
  e.task->target = {to};
  return e;
}

inline experiment::Experiment damped(experiment::Experiment e, double springs, double coupling, double viscosity = 0) {
  for (double& b : e.object.damping) b = springs;
  if (e.coupling) e.coupling->damping = coupling;
  e.object.viscosity = viscosity;
  return e;
}

/// The same object on a typed surface, from one pair of parameters to another.
inline experiment::Experiment onSurface(experiment::Experiment e, std::vector<std::string> formula, std::vector<double> from,
                                        std::vector<double> to) {
  e = onCurve(std::move(e), {}, 0, 1);
  e.constraint.surface = std::move(formula);
  e.task->start = std::move(from);
  e.task->target = std::move(to);
  return e;
}

/// The same object free in space.
inline experiment::Experiment freely(experiment::Experiment e, std::vector<double> from, std::vector<double> to) {
  e.constraint = {};
  e.constraint.name = "free";
  e.task->start = std::move(from);
  e.task->target = std::move(to);
  return e;
}

/// The hand itself moves as the criterion says, and not the one mass.
inline PredictOptions asHand() { return {.point = PointIs::Hand}; }

/// A hand that moves as the test says, and two masses, of which the last moves the other way and three times as fast.
class MadePrediction final : public Prediction {
 public:
  using Rate = std::function<double(double)>;
  MadePrediction(
      double seconds, Rate velocity, double fastest = 0, Rate acceleration = [](double) { return 0.0; })
      : velocity_(std::move(velocity)), acceleration_(std::move(acceleration)) {
    duration = seconds;
    handPeak = 1;
    fastest_ = fastest;
    massCount_ = 2;
  }
  PredictedHand handAt(double t) const override { return {0, velocity_(t), acceleration_(t)}; }
  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    position[0] = position[1] = 0;
    velocity[0] = 99;
    velocity[1] = -3 * velocity_(t);
  }

 private:
  Rate velocity_, acceleration_;
};

}  // namespace reachlab::predict
