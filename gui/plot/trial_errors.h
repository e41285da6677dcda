#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "constraints/geometry/task_path.h"
#include "gui/plot/trial_trace.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/predict/predict.h"

/// Theory beside the trial: each criterion's prediction for an experiment, and how far a hand was from it. No widget here.
namespace reachlab::gui::plot {

/// One criterion's prediction, or the reason why it is missing.
struct CriterionForecast {
  predict::Criterion criterion{};
  std::shared_ptr<const predict::Prediction> prediction;  // shared: computed on another thread, looked at by plot and list
  std::string refusal;
};
/// All seven criteria, in the order of Table 1. May take a second on curved constraints, so the window's thread must not call it. A stop
/// request leaves out the rest.
std::vector<CriterionForecast> forecastAll(const experiment::CompiledExperiment& experiment, const std::stop_token& stop = {});

/// The compared part of a trial: the recorded ticks, up to the end as the task judged it.
struct TrialSpan {
  std::uint64_t every = 1;                   // ticks a row of the recording
  std::uint64_t onsetTick = 0, endTick = 0;  // as judged; 0: not known, and all of the trace is looked at
};

/// The paper's epsilon of one trial, by the code of the analysis and from the recorded rows, so that it equals the number of `reach
/// analyze`. It is the RMS difference between the measured hand velocity and each forecast. Both reach from onset to end by the rule of the
/// analysis and are time-scaled to the measured duration. nullopt without a prediction or a movement. [m/s]
std::vector<std::optional<double>> computeHandErrors(std::span<const TracePoint> trace, const constraints::TaskPath& path,
                                                     const std::vector<CriterionForecast>& forecasts, const experiment::Task& task,
                                                     const TrialSpan& span = {});

}  // namespace reachlab::gui::plot
