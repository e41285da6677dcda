#pragma once
#include "gui/scene/scene_overlay.h"
#include "gui/scene_plan/force_marks.h"
#include "sim/experiment/experiment_fwd.h"
#include "sim/haptics/tick_state.h"

namespace reachlab::gui::scene {

/// Texts over the scene: the subject's next step, and the outcome of the last trial. `trialsBefore`: trials of the block in earlier
/// runs. Pure.
OverlayState overlayOf(const haptics::TickState& state, const experiment::Task& task, int trialsPlanned, bool mouse, int trialsBefore = 0);
/// Grey unless the trial counts: a trial that ended without success or failure has no square and no tone.
void showWhetherItCounts(const haptics::TickState& state, OverlayState& overlay);
/// Before a run.
OverlayState restingOverlay(const QString& experiment, bool mouse);
/// The task of the trials in a sentence with the numbers that are judged. `hiding`: masses are at the same position, and a second line
/// names the keys that part them. Empty without a task.
QString taskText(const experiment::Experiment& experiment, bool hiding);
/// What the drawn forces mean, a line each.
QString forcesText(const ForceMarks& forces);
/// Why a trial did not succeed, for the tally: "too fast", "still moving".
QString reasonText(trial::Reason reason);
/// How a trial ended, for the subject: "Too fast by 0.12 s", "Mass 5 still moved too fast: 0.004 m/s over".
QString outcomeText(const trial::TrialResult& result);

}  // namespace reachlab::gui::scene
