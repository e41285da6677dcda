#include "gui/app/session_overlay.h"

#include "gui/app/session_controller.h"
#include "gui/scene/trial_texts.h"

namespace reachlab::gui::app {
namespace {

bool isBeforeTheFirstReach(const haptics::TickState& state) {
  return state.trial <= 1 && (state.phase == trial::Phase::Idle || state.phase == trial::Phase::Waiting);
}

bool isOver(const session::RecordedRun& run) { return !run.underWay() && run.trialsLeft() == 0; }

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
    if (session.isPlan())
      overlay.counter =
          QStringLiteral("Block %1 of %2, ").arg(run->configuration().block).arg(session.blockCount()) + overlay.counter.toLower();
    if (isOver(*run)) {
      overlay.detail = session.blocksLeft() > 0 ? QStringLiteral("the block is done: rest; Space: next block")
                       : session.isPlan()       ? QStringLiteral("the session is complete")
                                                : QStringLiteral("the run is complete");
    }
  }
  if (run == nullptr || isBeforeTheFirstReach(run->latest())) overlay.task = scene::taskText(experiment, massesHide);
  return overlay;
}

scene::OverlayState subjectsOverlayOf(SessionController& session) {
  const session::RecordedRun* run = session.run();
  if (run == nullptr) return scene::subjectsRest();
  scene::OverlayState overlay = scene::subjectsOverlayOf(run->latest());
  if (isOver(*run)) overlay.detail = session.blocksLeft() > 0 ? QStringLiteral("Rest a little") : QStringLiteral("That was all: thank you");
  return overlay;
}

}  // namespace reachlab::gui::app
