#include "gui/app/session_overlay.h"

#include "gui/app/session_controller.h"
#include "gui/scene/trial_texts.h"

namespace reachlab::gui::app {
namespace {

bool isBeforeTheFirstReach(const haptics::TickState& state) {
  return state.trial <= 1 && (state.phase == trial::Phase::Idle || state.phase == trial::Phase::Waiting);
}

}  // namespace

scene::OverlayState overlayOf(SessionController& session, bool mouse, bool massesHide) {
  const experiment::Experiment& experiment = session.experiment();
  session::RecordedRun* run = session.run();
  scene::OverlayState overlay;
  if (run == nullptr) {
    overlay = scene::restingOverlay(QString::fromStdString(experiment.name), mouse);
  } else {
    overlay = scene::overlayOf(run->latest(), experiment.task.value_or(experiment::Task{}), static_cast<int>(run->trialCount()), mouse);
    if (!run->underWay() && run->latest().trial == 0) overlay.instruction = QStringLiteral("Press Space to begin");
    if (!run->underWay() && run->trialsLeft() == 0) overlay.detail = QStringLiteral("the run is complete");
  }
  if (run == nullptr || isBeforeTheFirstReach(run->latest())) overlay.task = scene::taskText(experiment, massesHide);
  return overlay;
}

scene::OverlayState subjectsOverlayOf(SessionController& session) {
  const session::RecordedRun* run = session.run();
  return run == nullptr ? scene::subjectsRest() : scene::subjectsOverlayOf(run->latest());
}

}  // namespace reachlab::gui::app
