#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <random>

#include "analysis/analysis.h"
#include "sim/experiment/experiment.h"

/// Trials made of a prediction with the usual human scatter, so that the truth is known.
namespace reachlab::analysis {

struct Scatter {
  double duration = 0.06;   // relative SD of the movement's duration
  double shape = 0.04;      // relative SD of a slow wave on the velocity
  double position = 20e-6;  // [m] white noise of the measured position
};

inline experiment::Experiment lineExperiment(experiment::ObjectKind kind, std::vector<double> masses, std::vector<double> stiffness,
                                             double coupling, double duration) {
  experiment::Experiment e;
  e.constraint.name = "line";
  e.constraint.shape = {{"length_m", 0.2}};
  e.object.kind = kind;
  e.object.masses = std::move(masses);
  e.object.damping.assign(stiffness.size(), 0.0);
  e.object.stiffness = std::move(stiffness);
  if (kind != experiment::ObjectKind::Parallel) e.coupling = experiment::Coupling{coupling, 0};
  experiment::Task task;
  task.start = {0};
  task.target = {6.283185307179586};
  task.duration = duration;
  e.task = task;
  e.name = "synthetic";
  return e;
}
inline experiment::Experiment chainExperiment(double duration) {
  return lineExperiment(experiment::ObjectKind::Chain, std::vector<double>(5, 0.6), std::vector<double>(4, 600.0), 600, duration);
}
inline experiment::CompiledExperiment compiledChain(double duration) { return experiment::CompiledExperiment(chainExperiment(duration)); }
inline experiment::Experiment parallelExperiment(double duration) {
  return lineExperiment(experiment::ObjectKind::Parallel, {3, 3}, {50, 250}, 0, duration);
}

/// A hand that ignores the object: 0.2 m by minimum jerk; every mass is thought to go with it.
class ObjectBlindPlan final : public predict::Prediction {
 public:
  ObjectBlindPlan(double seconds, std::size_t masses) {
    duration = seconds;
    distance = 0.2;
    massCount_ = static_cast<int>(masses);
  }
  predict::PredictedHand handAt(double t) const override {
    const double s = t / duration;
    return {distance * s * s * s * (10 - 15 * s + 6 * s * s), distance / duration * 30 * s * s * (1 - s) * (1 - s), 0};
  }
  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    std::fill(position.begin(), position.end(), handAt(t).position);
    std::fill(velocity.begin(), velocity.end(), handAt(t).velocity);
  }
};

/// A movement that follows `plan`, slower or faster and with a slow wave on it, with `rest` seconds of stillness before and after.
inline TrialData followPlan(const predict::Prediction& plan, const Scatter& scatter, std::mt19937_64& random, double rest = 0.4) {
  std::normal_distribution<double> normal;
  const double stretch = std::max(0.5, 1 + scatter.duration * normal(random));
  const double wave = scatter.shape * normal(random), phase = 6.283185307179586 * std::generate_canonical<double, 53>(random);
  TrialData trial;
  trial.rate = 100;
  trial.start = {-0.1, 0, 0};
  trial.target = {0.1, 0, 0};
  trial.along = {{1, 0, 0}};
  trial.result.outcome = trial::Outcome::Success;
  const double T = plan.duration * stretch;
  trial.goTime = 0.1;
  trial.taskOnset = rest;
  trial.taskEnd = rest + T;
  std::vector<double> position(static_cast<std::size_t>(plan.massCount())), velocity(position.size());
  double shift = 0;
  for (int i = 0; i <= static_cast<int>((T + 2 * rest) * trial.rate); ++i) {
    const double t = i / trial.rate - rest, s = std::clamp(t / T, 0.0, 1.0);
    const predict::PredictedHand hand = plan.handAt(s * plan.duration);
    plan.massesAt(s * plan.duration, position, velocity);
    const bool moving = t >= 0 && t <= T;
    // A bell that comes to rest with the movement, so that the wave neither moves the ends nor the end point much.
    shift = 0.05 * wave * std::sin(2 * 6.283185307179586 * s + phase) * std::pow(s * (1 - s), 3) * 16;
    trial.hand.push_back({-0.1 + hand.position + shift + scatter.position * normal(random), 0, 0});
    trial.object.push_back({-0.1 + position.back(), 0, 0});
    trial.objectVelocity.push_back({moving ? velocity.back() / stretch : 0, 0, 0});
    trial.force.push_back(1);
  }
  return trial;
}

using PlanOf = std::function<std::unique_ptr<predict::Prediction>(const experiment::Experiment&)>;

/// `subjects` x `days` x conditions, `trials` each, every movement planned by `criterion`.
inline AnalysisInput simulatedTrials(const std::vector<Condition>& conditions, const PlanOf& planOf, int subjects, int days, int trials,
                                     std::uint64_t seed, const Scatter& scatter = {}) {
  AnalysisInput input;
  input.conditions = conditions;
  std::mt19937_64 random(seed);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    const auto plan = planOf(conditions[c].experiment());
    for (int s = 1; s <= subjects; ++s)
      for (int d = 1; d <= days; ++d)
        for (int t = 1; t <= trials; ++t) {
          TrialData trial = followPlan(*plan, scatter, random);
          trial.key = {"S" + std::to_string(s), "0" + std::to_string(d), conditions[c].name, d, 1, 1, t};
          if (t % 5 == 0) {
            trial.result.outcome = trial::Outcome::Failure;
            trial.result.reason = trial::Reason::Velocity;
          }
          input.trials.push_back(std::move(trial));
          input.conditionOf.push_back(c);
        }
  }
  return input;
}
inline AnalysisInput simulatedTrials(const std::vector<Condition>& conditions, predict::Criterion criterion, double handMass, int subjects,
                                     int days, int trials, std::uint64_t seed, const Scatter& scatter = {}) {
  const auto planOf = [&](const experiment::Experiment& e) {
    predict::PredictOptions how;
    how.handMass = handMass;
    return predict::predict(e, criterion, how);
  };
  return simulatedTrials(conditions, planOf, subjects, days, trials, seed, scatter);
}

}  // namespace reachlab::analysis
