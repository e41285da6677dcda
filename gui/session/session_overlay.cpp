#include "gui/session/session_overlay.h"

#include <algorithm>
#include <cmath>

#include "gui/scene/trial_texts.h"
#include "gui/subject/subject_window.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::app {
namespace {

bool isBeforeTheFirstReach(const haptics::TickState& state) {
  return state.trial <= 1 && (state.phase == trial::Phase::Idle || state.phase == trial::Phase::Waiting);
}

bool isOver(SessionController& session) { return !session.run()->underWay() && session.run()->trialsLeft() == 0 && !session.follows(); }

scene::RestState restOf(SessionController& session, const QString& title) {
  return {title, session.instructions(), static_cast<int>(std::ceil(session.restLeft())), session.run()->configuration().block,
          static_cast<int>(session.blockCount())};
}

// ": channel, target 3" of a trial in a block that has kinds or targets.
QString sceneWords(const SessionController& session) {
  const std::vector<session::BlockScene>* scenes = session.shownScenes();
  if (scenes == nullptr) return {};
  const auto shown = std::find_if(scenes->begin(), scenes->end(), [&](const session::BlockScene& scene) {
    return &scene.experiment.experiment() == &session.experiment();
  });
  if (shown == scenes->end()) return {};
  QStringList words;
  if (!shown->kind.empty()) words << QString::fromStdString(shown->kind);
  if (!shown->target.empty()) words << QStringLiteral("target %1").arg(QString::fromStdString(shown->target));
  return ": " + words.join(", ");
}

// "Station 2 is missing. The window waits for it."; empty if every station sends.
QString missingStations(SessionController& session) {
  QStringList numbers;
  for (const network::StationStatus& status : session.statuses())
    if (status.station != session.station()->link.station && status.light == network::StationStatus::Light::Absent)
      numbers << QString::number(status.station);
  if (numbers.isEmpty()) return {};
  return numbers.size() == 1 ? QStringLiteral("Station %1 is missing. The window waits for it.").arg(numbers.front())
                             : QStringLiteral("Stations %1 are missing. The window waits for them.").arg(numbers.join(", "));
}

// Between trials it is the conductor who does something, and perhaps a line that is waited for.
void tellStations(SessionController& session, scene::OverlayState& overlay) {
  const haptics::TickState& state = session.run()->latest();
  if (session.follows()) overlay.counter = state.trial > 0 ? QStringLiteral("Trial %1").arg(state.trial) : QString();
  if (const QString missing = missingStations(session); !missing.isEmpty()) {
    overlay.instruction = missing;
    overlay.tone = scene::OverlayState::Tone::Bad;
    return;
  }
  if (session.run()->underWay()) return;
  const QString next = session.isArming()  ? "Waiting for the other stations"
                       : session.follows() ? "The conductor begins the next trial"
                                           : "Space: next trial";
  (state.trial == 0 ? overlay.instruction : overlay.detail) =
      state.trial == 0 && !session.isArming() && !session.follows() ? "Press Space to begin" : next;
}

// What the stations do, as far as a picture does not say it.
scene::OverlayState observersOverlay(SessionController& session) {
  using trial::Phase;
  scene::OverlayState overlay;
  const haptics::TickState* state = session.seen();
  overlay.counter = state != nullptr && state->trial > 0 ? QStringLiteral("Trial %1").arg(state->trial)
                                                         : QString::fromStdString(session.experiment().name);
  overlay.instruction = state == nullptr                 ? "Observing: nothing has come yet"
                        : state->phase == Phase::Waiting ? "Observing: the hands go to the start"
                        : state->phase == Phase::Armed   ? "Observing: every hand is at the start"
                        : state->phase == Phase::Moving  ? "Observing: they move"
                                                         : "Observing: between trials";
  return overlay;
}

}  // namespace

scene::OverlayState overlayOf(SessionController& session, bool mouse, bool massesHide) {
  if (session.observes()) return observersOverlay(session);
  const experiment::Experiment& experiment = session.experiment();
  session::RecordedRun* run = session.run();
  scene::OverlayState overlay;
  if (run == nullptr) {
    overlay = scene::restingOverlay(QString::fromStdString(experiment.name), mouse);
    if (session.resumes()) overlay.instruction = "Press Space to resume the session";
  } else {
    overlay = scene::overlayOf(run->latest(), experiment.task.value_or(experiment::Task{}), static_cast<int>(run->trialCount()), mouse,
                               run->configuration().firstTrial - 1);
    if (!run->underWay() && run->latest().trial == 0) overlay.instruction = "Press Space to begin";
    if (session.isPlan())
      overlay.counter = QStringLiteral("Block %1 of %2, ").arg(run->configuration().block).arg(session.blockCount()) +
                        overlay.counter.toLower() + sceneWords(session);
    if (session.station() != nullptr) tellStations(session, overlay);
    if (isOver(session)) {
      const bool more = session.blocksLeft() > 0;
      if (more)
        overlay.rest =
            restOf(session, session.restLeft() > 0 ? "Rest before the next block" : "The block is done. Space begins the next block.");
      overlay.detail = more ? QString() : session.isPlan() ? "The session is complete" : "The run is complete";
    }
  }
  const bool startPage = run == nullptr && session.isPlan();  // it says what is asked, and stands there
  if (!startPage && (run == nullptr || isBeforeTheFirstReach(run->latest()))) overlay.task = scene::taskText(experiment, massesHide);
  if (run != nullptr && !overlay.rest && (isOver(session) || isBeforeTheFirstReach(run->latest())))
    if (const QString words = session.instructions(); !words.isEmpty())
      overlay.task = overlay.task.isEmpty() ? words : words + QLatin1Char('\n') + overlay.task;
  return overlay;
}

scene::OverlayState subjectsOverlayOf(SessionController& session, const subject::SubjectWords& words, int score, const QString& before) {
  const experiment::SubjectScreen& screen = session.experiment().subjectScreen;
  scene::OverlayState overlay;
  overlay.rulersShown = false;
  overlay.below += subject::kPatchSide;
  overlay.semaphoreShown = screen.semaphore;
  session::RecordedRun* run = session.run();
  const haptics::TickState idle;
  const haptics::TickState& state = run == nullptr ? idle : run->latest();
  overlay.semaphore = state.semaphore;
  scene::showWhetherItCounts(state, overlay);
  if (screen.score) overlay.counter = QString::number(score);
  if (!screen.words) return overlay;
  overlay.instruction = words.instruction(state, screen.target);
  if (run != nullptr && session.station() != nullptr && !missingStations(session).isEmpty())
    overlay.instruction = words.instruction(haptics::TickState{}, screen.target);  // to wait
  if (run == nullptr) {
    if (session.isPlan()) overlay.task = before;
    return overlay;
  }
  if (isOver(session) && session.blocksLeft() > 0) overlay.rest = restOf(session, words.rest());
  else if (isOver(session)) overlay.detail = words.thanks();
  if (!overlay.rest && (isOver(session) || isBeforeTheFirstReach(state))) overlay.task = session.instructions();
  return overlay;
}

}  // namespace reachlab::gui::app
