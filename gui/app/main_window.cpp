#include "gui/app/main_window.h"

#include <QCloseEvent>
#include <QLabel>
#include <QTimer>
#include <QUndoStack>
#include <algorithm>
#include <utility>

#include "base/error.h"
#include "gui/docks/constraint_chooser.h"
#include "gui/docks/constraint_dock.h"
#include "gui/docks/coupling_dock.h"
#include "gui/plot/criterion_style.h"
#include "gui/widgets/fault_words.h"
#include "gui/app/main_window_impl.h"
#include "gui/docks/object_dock.h"
#include "gui/docks/prediction_dock.h"
#include "gui/scene/scene_view.h"
#include "gui/docks/session_dock.h"
#include "gui/subject/subject_window.h"
#include "gui/docks/task_dock.h"
#include "gui/scene/trial_texts.h"
#include "gui/plot/velocity_plot.h"

namespace reachlab::gui::app {
namespace {

constexpr int kFrameMs = 16;          // 60 Hz
constexpr int kSoftwareFrameMs = 33;  // 30 Hz where the processor draws
constexpr int kStatusEvery = 12;      // frames

// One change of what is to be done, as a whole: compiled already, so that it is undone without a word.
class EditCommand : public QUndoCommand {
 public:
  EditCommand(SessionController& session, session::Programme before, session::Programme after, const QString& what)
      : QUndoCommand(what), session_(session), before_(std::move(before)), after_(std::move(after)) {}
  void redo() override {
    if (!std::exchange(fresh_, false)) session_.setProgramme(after_);  // what is pushed has been done already
  }
  void undo() override { session_.setProgramme(before_); }
  // A slider's way is one edit.
  int id() const override { return text() == QLatin1String("shape") ? 1 : -1; }
  bool mergeWith(const QUndoCommand* other) override {
    after_ = static_cast<const EditCommand*>(other)->after_;
    return true;
  }

 private:
  bool fresh_ = true;
  SessionController& session_;
  session::Programme before_, after_;
};

}  // namespace

const experiment::Task& MainWindow::Impl::currentTask() const {
  static const experiment::Task none;
  return session.experiment().task ? *session.experiment().task : none;
}

void MainWindow::Impl::say(const QString& sentence) {
  message->setText(sentence);
  message->setVisible(!sentence.isEmpty());
}

void MainWindow::Impl::edit(const experiment::Experiment& changed, const QString& what,
                            const std::function<void(const QStringList&)>& showFaults) {
  experiment::Experiment same = changed;
  same.text = session.experiment().text;
  if (same == session.experiment()) return showFaults({});  // back to what holds: the run goes on
  const session::Programme before = session.programme();
  QStringList faults;
  try {
    faults = widgets::inWords(session.tryEdit(changed));
  } catch (const Error& e) {
    faults << QString::fromUtf8(e.what());
  }
  showFaults(faults);
  if (faults.isEmpty()) pushEdit(before, what);
}

void MainWindow::Impl::pushEdit(const session::Programme& before, const QString& what) {
  edits->push(new EditCommand(session, before, session.programme(), what));
}

void MainWindow::Impl::showExperiment() {
  const experiment::Experiment& e = session.experiment();
  object->setObject(e.object);
  coupling->setCoupling(e.coupling);
  if (e.task) task->setTask(*e.task, session.constraint().kind);
  constraint->setConstraint(e.constraint, session.constraint());
  for (QDockWidget* d : std::initializer_list<QDockWidget*>{object, task, constraint}) d->widget()->setEnabled(!session.isPlan());
  if (session.isPlan()) coupling->widget()->setEnabled(false);
  dock->setPlan(session.isPlan());
  plot->setTask(currentTask().duration, currentTask().tolerance.time);
  path = plot::PathDirection(e, session.constraint());
  rebuildScene();
  forecastsStale = true;
  window.setWindowTitle(QStringLiteral("%1 – Reachlab").arg(QString::fromStdString(e.name)));
}

void MainWindow::Impl::rebuildScene() {
  const scene::ScenePlan plan = scene::planScene(session.experiment(), session.constraint(), viewOptions);
  view->setPlan(plan);
  frame = scene::restingFrame(plan);
  if (subject != nullptr) subject->view().setPlan(plan);
  showOverlay();
}

void MainWindow::Impl::showOverlay() {
  const bool mouse = dock->device() == "mouse";
  if (session::RecordedRun* run = session.run())
    overlay = scene::overlayOf(run->latest(), currentTask(), static_cast<int>(run->trialCount()), mouse);
  else overlay = scene::restingOverlay(QString::fromStdString(session.experiment().name), mouse);
  if (session.run() && !session.underWay() && session.run()->latest().trial == 0)
    overlay.instruction = QStringLiteral("Press Space to begin");
  if (session.run() && session.run()->trialsLeft() == 0 && !session.underWay()) overlay.detail = QStringLiteral("the run is complete");
  const session::RecordedRun* open = session.run();
  if (open == nullptr ||
      (open->latest().trial <= 1 && (open->latest().phase == trial::Phase::Idle || open->latest().phase == trial::Phase::Waiting))) {
    const std::vector<Vec3>& shifts = view->plan().massShift;
    overlay.task = scene::taskText(
        session.experiment(), shifts.size() > 1 && std::all_of(shifts.begin(), shifts.end(), [](const Vec3& s) { return s == Vec3{}; }));
  }
  view->setOverlay(overlay);
  if (subject != nullptr) subject->view().setOverlay(overlay);
}

void MainWindow::Impl::showStage() {
  using Stage = docks::SessionDock::Stage;
  session::RecordedRun* run = session.run();
  dock->setStage(run == nullptr          ? Stage::Closed
                 : run->underWay()       ? Stage::UnderWay
                 : run->trialsLeft() > 0 ? Stage::BetweenTrials
                                         : Stage::Finished);
}

void MainWindow::Impl::next() {
  nextPlanned = false;
  if (session.run() == nullptr && !dock->fault().isEmpty()) return say(dock->fault());
  try {
    say({});
    if (!session.next(dock->request()) && session.run() == nullptr) say(QStringLiteral("The session is complete."));
  } catch (const std::exception& e) {
    say(QString::fromUtf8(e.what()));
  }
  showStage();
}

void MainWindow::Impl::drain() {
  plot::TracePoint p;
  while (session.tryTake(p)) {
    if (p.trial != traceTrial) {
      traceTrial = p.trial;
      trace.clear();
      plot->beginTrial();
    }
    if (p.phase != trial::Phase::Armed && p.phase != trial::Phase::Moving) continue;
    trace.push_back(p);
    if (p.phase == trial::Phase::Moving) plot->add(p.trialTime, path.along(p.handVelocity, p.firstQ), path.along(p.lastVelocity, p.lastQ));
  }
}

// Predictions are computed beside the window and taken over when they are there.
void MainWindow::Impl::tendForecasts() {
  using namespace std::chrono_literals;
  if (computing.valid() && computing.wait_for(0s) == std::future_status::ready) {
    forecasts = computing.get();
    if (!forecastsStale) {
      predictions->setForecasts(forecasts);
      drawPredictions();
    }
  }
  if (forecastsStale && !computing.valid()) {
    forecastsStale = false;
    predictions->setForecasts({});
    computing = std::async(std::launch::async, [experiment = session.experiment(), stop = stopComputing.get_token()] {
      return plot::forecastAll(experiment, stop);
    });
  }
  if (errorsDue && !computing.valid() && !forecastsStale) {
    errorsDue = false;
    predictions->addErrors(plot::computeHandErrors(trace, path, forecasts, currentTask()));
  }
}

void MainWindow::Impl::drawPredictions() {
  std::vector<plot::VelocityPlot::Line> lines;
  const std::vector<predict::Criterion> chosen = predictions->chosen();
  for (const plot::CriterionForecast& forecast : forecasts) {
    if (!forecast.prediction || std::find(chosen.begin(), chosen.end(), forecast.criterion) == chosen.end()) continue;
    plot::VelocityPlot::Line line{plot::titleOf(forecast.criterion), plot::colourOf(forecast.criterion), {}, {}};
    constexpr int kParts = 240;
    for (int i = 0; i <= kParts; ++i) {
      const double t = forecast.prediction->duration * i / kParts;
      line.time.push_back(t);
      line.velocity.push_back(forecast.prediction->handAt(t).velocity);
    }
    lines.push_back(std::move(line));
  }
  plot->setPredictions(lines);
}

void MainWindow::Impl::trialEnded() {
  const haptics::ConductedTrial trial = *session.lastTrial();
  dock->count(trial.result);
  if (trial.result.outcome == trial::Outcome::Success) sound.play();
  errorsDue = trial.result.outcome == trial::Outcome::Success || trial.result.outcome == trial::Outcome::Failure;
  session::RecordedRun* run = session.run();
  const double planned = run ? run->configuration().pauseSeconds : 0;
  if (run && run->trialsLeft() > 0 && (dock->repeatsByItself() || planned > 0)) {
    nextPlanned = true;
    nextAt = std::chrono::steady_clock::now() +
             std::chrono::milliseconds(static_cast<int>(1000 * (planned > 0 ? planned : dock->pauseSeconds())));
  }
  showStage();
}

void MainWindow::Impl::showStatus() {
  session::RecordedRun* run = session.run();
  if (run == nullptr) return;
  const haptics::LoopReport report = run->report();
  const haptics::TickState& s = run->latest();
  rate->setText(QStringLiteral("%1 Hz").arg(report.rate, 0, 'f', 1));
  rate->setToolTip(QStringLiteral("%1; lateness p50 %2 µs, p99 %3 µs, max %4 µs")
                       .arg(QString::fromStdString(report.mode))
                       .arg(report.latenessP50, 0, 'f', 0)
                       .arg(report.latenessP99, 0, 'f', 0)
                       .arg(report.latenessMax, 0, 'f', 0));
  ticks->setText(QStringLiteral("late %1  missed %2  clamped %3%4")
                     .arg(s.faults.lateTicks)
                     .arg(s.faults.missedTicks)
                     .arg(s.faults.clampedTicks)
                     .arg(s.faults.droppedRecords > 0 ? QStringLiteral("  not recorded %1").arg(s.faults.droppedRecords) : QString()));
}

void MainWindow::Impl::runOpened() {
  session::RecordedRun* run = session.run();
  dock->clearTally();
  predictions->clearErrors();
  traceTrial = 0;
  const dynamics::MethodChoice& choice = run->choice();
  method->setText(QStringLiteral("%1 (%2)").arg(QString::fromStdString(choice.method), QString::fromStdString(choice.form)));
  QString why = QString::fromStdString(choice.reason);
  for (const std::string& warning : choice.warnings) why += QLatin1Char('\n') + QString::fromStdString(warning);
  method->setToolTip(why);
  recording->setText(QString::fromStdString(run->logPath()));
  const record::RunConfiguration& c = run->configuration();
  QString text = QStringLiteral("run %1, block %2: %3").arg(c.run).arg(c.block).arg(QString::fromStdString(c.condition));
  if (c.practice) text += QStringLiteral(" (practice)");
  if (c.day > 0) text += QStringLiteral(", day %1").arg(c.day);
  dock->setRun(text + QStringLiteral("; seed %1").arg(c.seed));
  showStage();
}

void MainWindow::Impl::oneFrame() {
  session.poll();
  drain();
  tendForecasts();
  if (nextPlanned && std::chrono::steady_clock::now() >= nextAt) next();
  if (session::RecordedRun* run = session.run()) {
    scene::copyToFrame(run->latest(), frame);
    view->showFrame(frame);
    if (subject != nullptr) subject->view().showFrame(frame);
    showOverlay();
    plot->refresh();
  }
  if (++frames % kStatusEvery == 0) {
    showStatus();
    timer->setInterval(view->drawsInSoftware() ? kSoftwareFrameMs : kFrameMs);
  }
}

MainWindow::MainWindow(const session::SessionRequest& request, QWidget* parent)
    : QMainWindow(parent), impl_(std::make_unique<Impl>(*this, request)) {
  setObjectName(QStringLiteral("reachlab"));
  resize(1560, 960);
  impl_->makeDocks();
  impl_->makeStatusBar();
  impl_->makeMenus();
  impl_->dock->setRequest(request);
  impl_->wire();
  impl_->showExperiment();
}

MainWindow::~MainWindow() {
  if (QWidget* field = focusWidget()) field->clearFocus();  // an entry is taken when its field is left: while there is who takes it
  impl_->timer->stop();
  impl_->stopComputing.request_stop();
  delete impl_->subject;
}

SessionController& MainWindow::session() { return impl_->session; }
scene::SceneView& MainWindow::view() { return *impl_->view; }
plot::VelocityPlot& MainWindow::plot() { return *impl_->plot; }
docks::PredictionDock& MainWindow::predictions() { return *impl_->predictions; }
docks::SessionDock& MainWindow::sessionDock() { return *impl_->dock; }
scene::OverlayState MainWindow::overlay() const { return impl_->overlay; }
QString MainWindow::message() const { return impl_->message->isHidden() ? QString() : impl_->message->text(); }
bool MainWindow::predictionsReady() const { return !impl_->forecastsStale && !impl_->computing.valid(); }

void MainWindow::nextTrial() { impl_->next(); }
void MainWindow::openExperiment(const QString& what) { impl_->openExperiment(what); }

docks::ConstraintChooser& MainWindow::chooser() {
  if (impl_->chooser == nullptr) {
    impl_->chooser = new docks::ConstraintChooser(this);
    connect(impl_->chooser, &docks::ConstraintChooser::used, this, [this](const docks::ConstraintChoice& choice) {
      experiment::Experiment e = impl_->session.experiment();
      e.constraint = choice.spec;
      if (!e.task) e.task = experiment::Task{};
      e.task->start = choice.start;
      e.task->target = choice.target;
      impl_->edit(e, QStringLiteral("constraint"), [this](const QStringList& faults) { impl_->say(faults.join(QLatin1Char('\n'))); });
    });
  }
  return *impl_->chooser;
}

void MainWindow::chooseConstraint() {
  if (impl_->session.isPlan()) return;
  chooser().setCurrent(impl_->session.experiment());
  chooser().QDialog::show();
  chooser().raise();
}

void MainWindow::toggleSubjectWindow() {
  if (impl_->subject != nullptr) {
    impl_->subject->close();
    return;
  }
  impl_->subject = new subject::SubjectWindow;
  impl_->subject->setAttribute(Qt::WA_DeleteOnClose);
  connect(impl_->subject, &subject::SubjectWindow::closed, this, [this] { impl_->subject = nullptr; });
  scene::SceneView& view = impl_->subject->view();
  connect(&view, &scene::SceneView::handDragged, this, [this](double x, double y, double z) { impl_->session.pointTo(x, y, z); });
  view.setPlan(scene::planScene(impl_->session.experiment(), impl_->session.constraint(), impl_->viewOptions));
  view.setOverlay(impl_->overlay);
  impl_->subject->showFull();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  impl_->session.endRun();  // an unfinished trial is kept as interrupted
  if (impl_->subject != nullptr) impl_->subject->close();
  QMainWindow::closeEvent(event);
}

}  // namespace reachlab::gui::app
