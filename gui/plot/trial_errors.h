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

/// One criterion's prediction, or why there is none.
struct CriterionForecast {
  predict::Criterion criterion{};
  std::shared_ptr<const predict::Prediction> prediction;  // shared: computed on another thread, looked at by plot and list
  std::string refusal;
};
/// All seven, in Table 1's order; may take a second on curved constraints: not for the window's thread. Asked to stop, it leaves out the
/// rest.
std::vector<CriterionForecast> forecastAll(const experiment::CompiledExperiment& experiment, const std::stop_token& stop = {});

/// What of a trial is compared: the ticks that are in the recording, up to the end as the task saw it.
struct TrialSpan {
  std::uint64_t every = 1;                   // ticks a row of the recording
  std::uint64_t onsetTick = 0, endTick = 0;  // as judged; 0: not known, and all of the trace is looked at
};

/// The paper's epsilon of one trial, by the analysis' own code from the rows that the recording holds, so that it is `reach analyze`'s number.
/// RMS difference between the measured hand velocity and each forecast, both from onset to end by the rule of the analysis and time-scaled to the
/// measured duration: the paper's error for one trial. nullopt where there is no prediction or no movement. [m/s]
std::vector<std::optional<double>> computeHandErrors(std::span<const TracePoint> trace, const constraints::TaskPath& path,
                                                     const std::vector<CriterionForecast>& forecasts, const experiment::Task& task,
                                                     const TrialSpan& span = {});

}  // namespace reachlab::gui::plot
