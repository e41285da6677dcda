#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <cmath>

#include "gui/app/main_window.h"
#include "gui/session/remembered_session.h"
#include "gui/session/session_stage.h"
#include "gui/widgets/fault_in.h"

// What the window does at each step of a run.
namespace reachlab::gui::app {

void MainWindow::runOpened() {
  const session::RecordedRun& run = *session_.run();
  card_->close();
  strip_->clearTally();
  docks_.signal->clear();
  score_ = 0;
  succeeded_.clear();
  runFits_.cancel();
  fitAgain_ = false;
  strip_->showRun(run.configuration());
  predictions().clearErrors();
  docks_.trials->clear();
  trace_.beginRun();
  status_->runOpened(run);
  if (session_.station() == nullptr) {
    session::SessionRequest request = docks_.session->request();
    request.what = edits_.opened().what.toStdString();
    rememberOpenRun(run.configuration(), request);
  }
  plans_->refresh();
  showStage();
}

void MainWindow::runClosed() {
  forgetOpenRun();
  card_->close();
  status_->runClosed();
  plans_->refresh();
  screens_->showRest();
  showStage();
  showOverlay();
}

void MainWindow::drainTrace() {
  for (plot::TracePoint point; session_.tryTake(point);) trace_.add(point, plot(), *docks_.signal);
}

void MainWindow::trialEnded() {
  drainTrace();  // to its last point
  const trial::TrialResult result = session_.lastTrial()->result;
  strip_->count(result);
  if (session_.run() != nullptr) docks_.trials->add(session_.run()->numberOf(*session_.lastTrial()), result);
  if (result.outcome == trial::Outcome::Success) ++score_, sounds_.play(SoundCues::Cue::Success);
  if (result.outcome == trial::Outcome::Failure) sounds_.play(SoundCues::Cue::Failure);
  const bool judged = result.outcome == trial::Outcome::Success || result.outcome == trial::Outcome::Failure;
  if (judged && session_.run() != nullptr)
    forecast_.compare(trace_.points(), trace_.path(), {session_.run()->configuration().sampleEveryTicks, result.onsetTick, result.endTick},
                      result.outcome == trial::Outcome::Success);
  if (result.outcome == trial::Outcome::Success && session_.run() != nullptr) fitRun();
  showStage();
  if (stageOf(session_) == SessionStage::Finished) showEnd();
}

// What `reach analyze` would fit if the run ended here: the same rows, the same code.
void MainWindow::fitRun() {
  succeeded_.push_back(session_.run()->numberOf(*session_.lastTrial()));
  if (succeeded_.size() < analysis::kFewestTrials || session_.run()->configuration().practice) return;
  fitted_ = session_.run()->logPath();
  if (runFits_.busy()) fitAgain_ = true;
  else runFits_.fit({{fitted_, succeeded_}});
}

void MainWindow::oneFrame() {
  session_.poll();
  drainTrace();
  if (QApplication::activeModalWidget() == nullptr && session_.takeNextTrial()) nextTrial();  // nobody answers a question in a movement
  if (const haptics::TickState* seen = session_.seen()) {
    screens_->showState(*seen, session_.otherHands());
    showOverlay();
  }
  if (session_.run() == nullptr) return;
  screens_->showState(session_.run()->latest(), session_.otherHands());
  playGo(session_.run()->latest());
  showOverlay();
  plot().refresh();
  docks_.signal->refresh();
}

void MainWindow::joinStations() {
  messages_->say(widgets::Grade::Error, widgets::faultIn([this] { session_.join(docks_.session->request()); }));
  showStage();
  showStations();
}

void MainWindow::showStations() {
  if (docks_.stations == nullptr) return;
  using Stage = docks::StationsDock::Stage;
  const Stage stage = session_.observes()          ? Stage::Observing
                      : session_.run() == nullptr  ? Stage::Closed
                      : session_.isArming()        ? Stage::Arming
                      : session_.run()->underWay() ? Stage::UnderWay
                                                   : Stage::BetweenTrials;
  docks_.stations->showStations(*session_.station(), stage, session_.statuses());
}

// With the picture that shows the signal.
void MainWindow::playGo(const haptics::TickState& state) {
  const bool gone = state.gone && (state.phase == trial::Phase::Armed || state.phase == trial::Phase::Moving);
  if (gone && !gone_) sounds_.play(SoundCues::Cue::Go);
  gone_ = gone;
}

// What a run ends with: its counts, its folder, and what can follow.
void MainWindow::showEnd() {
  const record::RunConfiguration& run = session_.run()->configuration();
  const QString folder = dataFolder();
  std::vector<widgets::Card::Choice> choices{{tr("Inspect"), "endInspect", [this, folder] {
                                                session_.endRun();
                                                inspect(folder);
                                              }}};
  choices.push_back({tr("Next subject"), "endNextSubject", [this] {
                       session_.endRun();
                       nextSubject();
                     }});
  if (!session_.isPlan()) choices.push_back({tr("Next run"), "endNextRun", [this] { session_.endRun(); }});
  card_->offer(session_.isPlan() ? tr("The session is complete") : tr("Run %1 is complete").arg(run.run),
               tr("%1\n\nSubject %2, session %3.\nRecorded in %4")
                   .arg(strip_->tally(), QString::fromStdString(run.subject), QString::fromStdString(run.session), folder),
               choices, false);  // a key that went astray ends nothing
}

// What is typed in a field is taken when the field loses the focus, and a button or a key outside of it does not take the focus.
void MainWindow::takeEntry() {
  QWidget* const entry = focusWidget();
  if (entry == nullptr || strip_->isAncestorOf(entry)) return;
  if (qobject_cast<QLineEdit*>(entry) == nullptr && qobject_cast<QAbstractSpinBox*>(entry) == nullptr &&
      qobject_cast<QComboBox*>(entry) == nullptr)
    return;
  entry->clearFocus();
  entry->setFocus();
}

void MainWindow::nextTrial() {
  if (session_.run() == nullptr) takeEntry();
  if (session_.run() == nullptr && plans_->resumes()) session_.resume();
  beginNext();
}

void MainWindow::beginNext() {
  session_.cancelPause();
  if (session_.restLeft() > 0)
    return warn(tr("The plan rests %1 s more before its next block. Ctrl+E ends the run of this block and the rest.")
                    .arg(std::ceil(session_.restLeft())));
  if (session_.run() == nullptr && !docks_.session->fault().isEmpty()) return say(docks_.session->fault());
  if (session_.run() == nullptr && !mayKeepValues("Start")) return;
  const QString fault = widgets::faultIn([this] {
    messages_->clear();
    if (session_.run() == nullptr && !mayUseDevice()) return;
    if (!session_.next(docks_.session->request()) && session_.run() == nullptr) tell(tr("The session is complete."));
  });
  messages_->say(widgets::Grade::Error, fault);
  showStage();
}

void MainWindow::abortTrial() {
  session_.abort();
  showStage();  // a trial that was not armed yet has no end
}

void MainWindow::repeatTrial() {
  if (!session_.repeat()) return;
  card_->close();
  showStage();
  showOverlay();
}

void MainWindow::resumeSession() {
  if (stageOf(session_) == SessionStage::Finished) session_.endRun();  // what is left is seen on the disk
  if (session_.run() == nullptr) takeEntry();
  session_.resume();
  beginNext();
}

void MainWindow::endRun() {
  if (session_.run() == nullptr) return;
  const int run = session_.run()->configuration().run;
  if (!mayEndRun(tr("End run")) || session_.run() == nullptr) return;  // a fault may end it behind the question
  if (session_.endRun()) tell(tr("Run %1 is saved in %2.").arg(run).arg(dataFolder()));
}

void MainWindow::nextSubject() {
  if (session_.run() == nullptr) docks_.session->nextSubject();
}

void MainWindow::offerResume() {
  std::optional<InterruptedRun> found;
  if (const QString fault = widgets::faultIn([&] { found = findInterruptedRun(); }); !fault.isEmpty()) {
    forgetOpenRun();
    return warn(tr("The interrupted run cannot be resumed. %1").arg(fault));
  }
  if (!found) return;
  const session::SessionPlace& place = found->request.place;
  card_->offer(tr("Resume session %1 of subject %2 at trial %3 of %4?")
                   .arg(QString::fromStdString(place.session), QString::fromStdString(place.subject))
                   .arg(found->trial)
                   .arg(found->trials),
               tr("Run %1 was interrupted. Its finished trials are safe in %2.\n\nDevice %3, seed %4. The first trial waits for Space.")
                   .arg(found->run)
                   .arg(QString::fromStdString(place.data), QString::fromStdString(found->request.device), found->seed),
               {{tr("Not now"), "resumeNot", [] { forgetOpenRun(); }},
                {tr("Resume"), "resumeYes",
                 [this, run = *found] {
                   session::SessionRequest request = docks_.session->request();  // with the instruments and the backup of this start
                   request.what = run.request.what;
                   request.place = run.request.place;
                   request.participant = run.request.participant;
                   request.day = run.request.day;
                   request.device = run.request.device;
                   request.trials = run.request.trials;
                   request.seed.reset();  // the session has one
                   session_.resume(request);
                   const QString what = QString::fromStdString(run.request.what);
                   edits_.open(run.programme, tr("resume"), {what, what});
                   edits_.stack().setClean();
                   docks_.session->setRequest(request);
                   docks_.session->showExperiment(session_.compiled(), !session_.isPlan());
                   showOverlay();
                 }}},
               true);
}

}  // namespace reachlab::gui::app
