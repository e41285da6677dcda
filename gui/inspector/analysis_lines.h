#pragma once
#include <vector>

#include "analysis/figure/figure.h"
#include "gui/inspector/inspection.h"
#include "gui/inspector/profile_plot.h"

/// The drawn lines of an inspection as numbers, the same for plot, figure and file. Pure.
namespace reachlab::gui::inspector {

/// Velocity of the hand along the path, or of the last mass.
enum class Signal { Hand, Object };
/// As it was moved, or time-scaled to the mean of the chosen trials as in the report's figures.
enum class TimeAxis { AsMoved, Scaled };

/// One line per trial, in the order of trials [s], [m/s]. Time counts from the trial's onset, or from its arming if there was no movement.
std::vector<ProfilePlot::Line> linesOf(const Inspection& inspection, Signal signal, TimeAxis axis);
/// Onset of a trial on the clock of its samples: 0 on the plot. [s] since arming
double zeroOf(const Inspection& inspection, std::size_t trial);

/// Over the counted trials of the condition. Empty if no trial counts.
ProfilePlot::Mean meanOf(const analysis::Analysis& analysis, std::size_t condition, Signal signal);

/// Which predictions are drawn: for the task's T, dashed, and the mean of the fitted movements, dotted.
struct ShownPredictions {
  std::vector<predict::Criterion> criteria;
  bool predicted = true, fitted = true;
};
std::vector<plot::PredictedLine> predictionsOf(const analysis::Analysis& analysis, std::size_t condition, Signal signal,
                                               const ShownPredictions& shown);

/// All of it for print.
figure::Figure figureOf(const Inspection& inspection, std::size_t condition, TimeAxis axis, const ShownPredictions& shown);
/// The lines as they are drawn, one row a sample: trial, time, hand and object velocity.
std::string linesCsv(const Inspection& inspection, TimeAxis axis);

}  // namespace reachlab::gui::inspector
