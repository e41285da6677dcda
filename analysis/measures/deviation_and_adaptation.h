#pragma once
#include <optional>

#include "analysis/measures/measures.h"
#include "analysis/trials/trial_data.h"
#include "sim/experiment/experiment_fwd.h"

namespace reachlab::analysis {

/// The sum of an experiment's viscous fields [N s/m]. No value for an experiment without such a field.
std::optional<experiment::SquareMatrix<3>> viscousFieldOf(const experiment::Experiment& experiment);
/// The strength of a field relative to the trained field: <field, trained> / <trained, trained> over the matrices' elements.
double strengthOf(const experiment::SquareMatrix<3>& field, const experiment::SquareMatrix<3>& trained);
/// The forces and the cursor of a trial's scene, as the measures need them. `trained`: the field that a channel trial is to measure. It is
/// the strongest of the block, or of the subject's last block that had a field.
TrialScene sceneOf(const experiment::Experiment& experiment, const std::optional<experiment::SquareMatrix<3>>& trained);

/// Measures across the straight way from start to target, from the rows as they were recorded, unfiltered, between the task's onset and
/// the trial's end. d is the hand's distance from the line to the right in the task's plane, v its recorded velocity along the line.
///   deviation   d where |d| is largest, and d at the largest recorded speed
///   angle       of the way from the start, counterclockwise from the target: at the largest speed, and where the hand first reaches the
///               target's distance from the start
///   leak        largest distance from the line on all sides, in a channel
///   adaptation  100 sum F F* / sum F*^2 with F* = b v, over the samples within 0.2 s of the largest speed, no intercept. F is the force
///               to the right that the channel returns, and b the force to the right of the trained field for each m/s along the way.
///               R^2 = 1 - sum (F - a F*)^2 / sum F^2 (Sheahan, Franklin & Wolpert 2016)
/// Everything stays unmeasured on a bent constraint, and where the way is at right angles to the plane.
void measureAcross(const TrialData& trial, TrialMeasures& measures);

}  // namespace reachlab::analysis
