#include "gui/main_window.h"

#include <QAction>
#include <QActionGroup>
#include <QCloseEvent>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QSaveFile>
#include <QStatusBar>
#include <QTimer>
#include <QToolButton>
#include <QUndoStack>
#include <QVBoxLayout>
#include <chrono>
#include <functional>
#include <future>
#include <stop_token>
#include <utility>

#include "constraints/error.h"
#include "gui/constraint_chooser.h"
#include "gui/constraint_dock.h"
#include "gui/coupling_dock.h"
#include "gui/criterion_style.h"
#include "gui/object_dock.h"
#include "gui/prediction_dock.h"
#include "gui/scene_view.h"
#include "gui/session_controller.h"
#include "gui/session_dock.h"
#include "gui/subject_window.h"
#include "gui/success_sound.h"
#include "gui/task_dock.h"
#include "gui/trial_errors.h"
#include "gui/trial_texts.h"
#include "gui/velocity_plot.h"

namespace reachlab {
namespace {

constexpr int kFrameMs = 16;          // 60 Hz
constexpr int kSoftwareFrameMs = 33;  // 30 Hz where the processor draws
constexpr int kStatusEvery = 12;      // frames

// One edit of the experiment as a whole: small, and undone without a special case.
class EditCommand : public QUndoCommand {
 public:
  EditCommand(SessionController& session, Experiment before, Experiment after, const QString& what)
      : QUndoCommand(what), session_(session), before_(std::move(before)), after_(std::move(after)) {}
  void redo() override {
    if (!std::exchange(fresh_, false)) session_.tryEdit(after_);  // what is pushed has been done already
  }
  void undo() override { session_.tryEdit(before_); }
  // A slider's way is one edit.
  int id() const override { return text() == QLatin1String("shape") ? 1 : -1; }
  bool mergeWith(const QUndoCommand* other) override {
    after_ = static_cast<const EditCommand*>(other)->after_;
    return true;
  }

 private:
  bool fresh_ = true;
  SessionController& session_;
  Experiment before_, after_;
};

}  // namespace

struct MainWindow::Impl {
  MainWindow& window;
  SessionController session;
  SceneView* view = nullptr;
  VelocityPlot* plot = nullptr;
  ObjectDock* object = nullptr;
  CouplingDock* coupling = nullptr;
  TaskDock* task = nullptr;
  PredictionDock* predictions = nullptr;
  SessionDock* dock = nullptr;
  ConstraintDock* constraint = nullptr;
  ConstraintChooser* chooser = nullptr;
  SubjectWindow* subject = nullptr;
  QLabel *message = nullptr, *rate = nullptr, *ticks = nullptr, *method = nullptr, *recording = nullptr;
  QUndoStack* edits = nullptr;
  QTimer* timer = nullptr;
  SuccessSound sound;
  ViewOptions viewOptions;
  SceneFrame frame;
  OverlayState overlay;
  PathDirection path;
  std::vector<TracePoint> trace;  // of the trial under way, or the last
  std::int32_t traceTrial = 0;
  std::vector<CriterionForecast> forecasts;
  std::stop_source stopComputing;
  std::future<std::vector<CriterionForecast>> computing;
  bool forecastsStale = true, errorsDue = false;
  int frames = 0;
  std::chrono::steady_clock::time_point nextAt{};
  bool nextPlanned = false;

  Impl(MainWindow& w, const SessionRequest& request) : window(w), session(request) {}

  const Task& currentTask() const {
    static const Task none;
    return session.experiment().task ? *session.experiment().task : none;
  }

  void say(const QString& sentence) {
    message->setText(sentence);
    message->setVisible(!sentence.isEmpty());
  }

  void edit(const Experiment& changed, const QString& what, const std::function<void(const QStringList&)>& showFaults) {
    const Experiment before = session.experiment();
    const QStringList faults = session.tryEdit(changed);
    showFaults(faults);
    if (faults.isEmpty()) edits->push(new EditCommand(session, before, changed, what));
  }

  void showExperiment() {
    const Experiment& e = session.experiment();
    object->setObject(e.object);
    coupling->setCoupling(e.coupling);
    if (e.task) task->setTask(*e.task);
    constraint->setConstraint(e.constraint, session.constraint());
    for (QDockWidget* d : std::initializer_list<QDockWidget*>{object, task, constraint}) d->widget()->setEnabled(!session.isPlan());
    if (session.isPlan()) coupling->widget()->setEnabled(false);
    plot->setTask(currentTask().duration, currentTask().tolerance.time);
    path = PathDirection(e, session.constraint());
    rebuildScene();
    forecastsStale = true;
    window.setWindowTitle(QStringLiteral("%1 – Reachlab").arg(QString::fromStdString(e.name)));
  }

  void rebuildScene() {
    const ScenePlan plan = planScene(session.experiment(), session.constraint(), viewOptions);
    view->setPlan(plan);
    frame = restingFrame(plan);
    if (subject != nullptr) subject->view().setPlan(plan);
    showOverlay();
  }

  void showOverlay() {
    const bool mouse = dock->device() == "mouse";
    if (WindowRun* run = session.run()) overlay = overlayOf(run->latest(), currentTask(), static_cast<int>(run->trialCount()), mouse);
    else overlay = restingOverlay(QString::fromStdString(session.experiment().name), mouse);
    if (session.run() && !session.underWay() && session.run()->latest().trial == 0) overlay.instruction = QStringLiteral("Press Space to begin");
    if (session.run() && session.run()->trialsLeft() == 0 && !session.underWay()) overlay.detail = QStringLiteral("the run is complete");
    view->setOverlay(overlay);
    if (subject != nullptr) subject->view().setOverlay(overlay);
  }

  void showStage() {
    using Stage = SessionDock::Stage;
    WindowRun* run = session.run();
    dock->setStage(run == nullptr ? Stage::Closed : run->underWay() ? Stage::UnderWay : run->trialsLeft() > 0 ? Stage::BetweenTrials : Stage::Finished);
  }

  void next() {
    nextPlanned = false;
    try {
      say({});
      if (!session.next(dock->request()) && session.run() == nullptr) say(QStringLiteral("The session is complete."));
    } catch (const std::exception& e) {
      say(QString::fromUtf8(e.what()));
    }
    showStage();
  }

  void drain() {
    WindowRun* run = session.run();
    if (run == nullptr) return;
    TracePoint p;
    while (run->tryTake(p)) {
      if (p.trial != traceTrial) {
        traceTrial = p.trial;
        trace.clear();
        plot->beginTrial();
      }
      if (p.phase != Phase::Armed && p.phase != Phase::Moving) continue;
      trace.push_back(p);
      if (p.phase == Phase::Moving) plot->add(p.trialTime, path.along(p.handVelocity, p.firstQ), path.along(p.lastVelocity, p.lastQ));
    }
  }

  // Predictions are computed beside the window and taken over when they are there.
  void tendForecasts() {
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
      computing = std::async(std::launch::async, [experiment = session.experiment(), stop = stopComputing.get_token()] { return forecastAll(experiment, stop); });
    }
    if (errorsDue && !computing.valid() && !forecastsStale) {
      errorsDue = false;
      predictions->addErrors(computeHandErrors(trace, path, forecasts, currentTask()));
    }
  }

  void drawPredictions() {
    std::vector<VelocityPlot::Line> lines;
    const std::vector<Criterion> chosen = predictions->chosen();
    for (const CriterionForecast& forecast : forecasts) {
      if (!forecast.prediction || std::find(chosen.begin(), chosen.end(), forecast.criterion) == chosen.end()) continue;
      VelocityPlot::Line line{titleOf(forecast.criterion), colourOf(forecast.criterion), {}, {}};
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

  void trialEnded() {
    const ConductedTrial trial = *session.lastTrial();
    dock->count(trial.result);
    if (trial.result.outcome == Outcome::Success) sound.play();
    errorsDue = trial.result.outcome == Outcome::Success || trial.result.outcome == Outcome::Failure;
    WindowRun* run = session.run();
    const double planned = run ? run->configuration().pauseSeconds : 0;
    if (run && run->trialsLeft() > 0 && (dock->repeatsByItself() || planned > 0)) {
      nextPlanned = true;
      nextAt = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<int>(1000 * (planned > 0 ? planned : dock->pauseSeconds())));
    }
    showStage();
  }

  void showStatus() {
    WindowRun* run = session.run();
    if (run == nullptr) return;
    const LoopReport report = run->report();
    const TickState& s = run->latest();
    rate->setText(QStringLiteral("%1 Hz").arg(report.rate, 0, 'f', 1));
    rate->setToolTip(QStringLiteral("%1; lateness p50 %2 µs, p99 %3 µs, max %4 µs")
                         .arg(QString::fromStdString(report.mode)).arg(report.latenessP50, 0, 'f', 0).arg(report.latenessP99, 0, 'f', 0).arg(report.latenessMax, 0, 'f', 0));
    ticks->setText(QStringLiteral("late %1  missed %2  clamped %3%4")
                       .arg(s.faults.lateTicks).arg(s.faults.missedTicks).arg(s.faults.clampedTicks)
                       .arg(s.faults.droppedRecords > 0 ? QStringLiteral("  not recorded %1").arg(s.faults.droppedRecords) : QString()));
  }

  void runOpened() {
    WindowRun* run = session.run();
    dock->clearTally();
    predictions->clearErrors();
    traceTrial = 0;
    const MethodChoice& choice = run->choice();
    method->setText(QStringLiteral("%1 (%2)").arg(QString::fromStdString(choice.method), QString::fromStdString(choice.form)));
    QString why = QString::fromStdString(choice.reason);
    for (const std::string& warning : choice.warnings) why += QLatin1Char('\n') + QString::fromStdString(warning);
    method->setToolTip(why);
    recording->setText(QString::fromStdString(run->logPath()));
    const RunConfiguration& c = run->configuration();
    QString text = QStringLiteral("run %1, block %2: %3").arg(c.run).arg(c.block).arg(QString::fromStdString(c.condition));
    if (c.practice) text += QStringLiteral(" (practice)");
    if (c.day > 0) text += QStringLiteral(", day %1").arg(c.day);
    dock->setRun(text + QStringLiteral("; seed %1").arg(c.seed));
    showStage();
  }

  void oneFrame() {
    session.poll();
    drain();
    tendForecasts();
    if (nextPlanned && std::chrono::steady_clock::now() >= nextAt) next();
    if (WindowRun* run = session.run()) {
      copyToFrame(run->latest(), frame);
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

  void makeDocks();
  void makeMenus();
  void makeStatusBar();
  void wire();
  void openExperiment(const QString& what);
  void saveExperiment();
};

void MainWindow::Impl::makeDocks() {
  auto* middle = new QWidget;
  auto* layout = new QVBoxLayout(middle);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  message = new QLabel;
  message->setObjectName(QStringLiteral("message"));
  message->setStyleSheet(QStringLiteral("background: #6b2b25; color: white; padding: 8px 12px; font-weight: 600;"));
  message->setWordWrap(true);
  message->hide();
  layout->addWidget(message);
  view = new SceneView;
  view->setObjectName(QStringLiteral("scene"));
  layout->addWidget(view, 1);
  window.setCentralWidget(middle);

  plot = new VelocityPlot;
  auto* plotDock = new QDockWidget(QStringLiteral("Velocity"), &window);
  plotDock->setObjectName(QStringLiteral("plotDock"));
  plotDock->setWidget(plot);
  object = new ObjectDock(&window);
  coupling = new CouplingDock(&window);
  task = new TaskDock(&window);
  predictions = new PredictionDock(&window);
  dock = new SessionDock(&window);
  constraint = new ConstraintDock(&window);
  window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  window.addDockWidget(Qt::BottomDockWidgetArea, plotDock);
  window.addDockWidget(Qt::LeftDockWidgetArea, dock);
  window.addDockWidget(Qt::LeftDockWidgetArea, constraint);
  window.addDockWidget(Qt::LeftDockWidgetArea, predictions);
  for (QDockWidget* d : std::initializer_list<QDockWidget*>{object, coupling, task}) window.addDockWidget(Qt::RightDockWidgetArea, d);
  window.resizeDocks({plotDock}, {270}, Qt::Vertical);
  window.resizeDocks({dock, object}, {330, 300}, Qt::Horizontal);
}

void MainWindow::Impl::makeStatusBar() {
  rate = new QLabel(QStringLiteral("no run is open"));
  ticks = new QLabel;
  method = new QLabel;
  recording = new QLabel;
  recording->setObjectName(QStringLiteral("recording"));
  recording->setTextInteractionFlags(Qt::TextSelectableByMouse);
  for (QLabel* label : {rate, ticks, method}) window.statusBar()->addWidget(label);
  window.statusBar()->addPermanentWidget(recording);
}

void MainWindow::Impl::openExperiment(const QString& what) {
  try {
    Experiment e = readExperiment(what.toStdString());
    edit(e, QStringLiteral("open %1").arg(what), [this](const QStringList& faults) { say(faults.join(QLatin1Char('\n'))); });
  } catch (const Error& e) {
    say(QString::fromUtf8(e.what()));
  }
}

void MainWindow::Impl::saveExperiment() {
  const QString file = QFileDialog::getSaveFileName(&window, QStringLiteral("Save experiment"), QString::fromStdString(session.experiment().name + ".json"),
                                                    QStringLiteral("Experiments (*.json)"));
  if (file.isEmpty()) return;
  QSaveFile out(file);
  const std::string text = toJson(session.experiment());
  if (!out.open(QIODevice::WriteOnly) || out.write(text.data(), static_cast<qint64>(text.size())) < 0 || !out.commit())
    say(QStringLiteral("%1: could not be written: %2").arg(file, out.errorString()));
}

void MainWindow::Impl::makeMenus() {
  edits = new QUndoStack(&window);
  const auto add = [this](QMenu* menu, const QString& text, const QKeySequence& key, auto slot) {
    QAction* action = menu->addAction(text);
    action->setShortcut(key);
    QObject::connect(action, &QAction::triggered, &window, slot);
    return action;
  };
  QMenu* file = window.menuBar()->addMenu(QStringLiteral("&Experiment"));
  add(file, QStringLiteral("&Open…"), QKeySequence::Open, [this] {
    const QString chosen = QFileDialog::getOpenFileName(&window, QStringLiteral("Open experiment"), {}, QStringLiteral("Experiments (*.json)"));
    if (!chosen.isEmpty()) openExperiment(chosen);
  });
  QMenu* shipped = file->addMenu(QStringLiteral("S&hipped"));
  for (const std::string& name : shippedExperiments()) add(shipped, QString::fromStdString(name), {}, [this, name] { openExperiment(QString::fromStdString(name)); });
  add(file, QStringLiteral("&Save as…"), QKeySequence::SaveAs, [this] { saveExperiment(); });
  file->addSeparator();
  add(file, QStringLiteral("&Quit"), QKeySequence::Quit, [this] { window.close(); });

  QMenu* edit = window.menuBar()->addMenu(QStringLiteral("E&dit"));
  QAction* undo = edits->createUndoAction(&window, QStringLiteral("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = edits->createRedoAction(&window, QStringLiteral("&Redo"));
  redo->setShortcut(QKeySequence::Redo);
  edit->addActions({undo, redo});
  edit->addSeparator();
  add(edit, QStringLiteral("Choose or type a &constraint…"), QKeySequence(QStringLiteral("Ctrl+K")), [this] { window.chooseConstraint(); });

  QMenu* trial = window.menuBar()->addMenu(QStringLiteral("&Trial"));
  add(trial, QStringLiteral("&Next"), Qt::Key_Space, [this] { next(); });
  add(trial, QStringLiteral("&Abort"), Qt::Key_Escape, [this] { session.abort(); });
  add(trial, QStringLiteral("&Repeat"), Qt::Key_R, [this] {
    if (session.repeat()) showStage(), showOverlay();
  });
  add(trial, QStringLiteral("&End run"), QKeySequence(QStringLiteral("Ctrl+E")), [this] { session.endRun(); });

  QMenu* show = window.menuBar()->addMenu(QStringLiteral("&View"));
  add(show, QStringLiteral("&Whole scene"), Qt::Key_Home, [this] { view->resetCamera(); });
  for (const char axis : {'x', 'y', 'z'})
    add(show, QStringLiteral("Along %1").arg(QLatin1Char(axis)), QKeySequence(QStringLiteral("Ctrl+%1").arg(axis == 'x' ? 1 : axis == 'y' ? 2 : 3)), [this, axis] { view->lookAlong(axis); });
  show->addSeparator();
  QAction* aside = add(show, QStringLiteral("&Masses side by side"), Qt::Key_F, [this](bool on) {
    viewOptions.sideBySide = on ? ViewOptions::SideBySide::Always : ViewOptions::SideBySide::Never;
    const Camera kept = view->camera();
    rebuildScene();
    view->setCamera(kept);
  });
  aside->setCheckable(true);
  aside->setObjectName(QStringLiteral("sideBySide"));
  aside->setChecked(session.experiment().object.kind == ObjectKind::Parallel);
  QAction* wire = add(show, QStringLiteral("Surfaces as &wire frame"), Qt::Key_W, [this](bool on) { view->setSurfaceStyle(on ? SurfaceStyle::Wire : SurfaceStyle::Glass); });
  wire->setCheckable(true);
  show->addSeparator();
  add(show, QStringLiteral("&Subject's screen"), Qt::Key_F11, [this] { window.toggleSubjectWindow(); });
  QAction* quiet = add(show, QStringLiteral("Without s&ound"), {}, [this](bool on) { sound.setMuted(on); });
  quiet->setCheckable(true);
  show->addSeparator();
  for (QDockWidget* d : window.findChildren<QDockWidget*>()) show->addAction(d->toggleViewAction());

  QMenu* help = window.menuBar()->addMenu(QStringLiteral("&Help"));
  add(help, QStringLiteral("&Keys and mouse"), Qt::Key_F1, [this] {
    auto* box = new QMessageBox(QMessageBox::NoIcon, QStringLiteral("Keys and mouse"),
                                QStringLiteral("<table cellpadding=3><tr><td><b>left drag</b></td><td>moves the hand (device mouse)</td></tr>"
                                               "<tr><td><b>right drag</b></td><td>turns</td></tr><tr><td><b>middle drag</b></td><td>shifts</td></tr>"
                                               "<tr><td><b>wheel</b></td><td>nearer, farther</td></tr><tr><td><b>Space</b></td><td>next trial</td></tr>"
                                               "<tr><td><b>Esc</b></td><td>abort the trial</td></tr><tr><td><b>R</b></td><td>repeat the last trial</td></tr>"
                                               "<tr><td><b>F</b></td><td>masses side by side</td></tr><tr><td><b>Ctrl+K</b></td><td>constraints</td></tr>"
                                               "<tr><td><b>F11</b></td><td>subject's screen</td></tr></table>"),
                                QMessageBox::Close, &window);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->show();
  });
  add(help, QStringLiteral("&About"), {}, [this] {
    auto* box = new QMessageBox(QMessageBox::NoIcon, QStringLiteral("Reachlab"),
                                QStringLiteral("<b>Reachlab %1</b><br>A laboratory for rest-to-rest reaching movements.<br>BSD-3-Clause.<br><br>Drawn by %2")
                                    .arg(QStringLiteral(REACHLAB_VERSION), view->rendererName().toHtmlEscaped()),
                                QMessageBox::Close, &window);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->show();
  });
}

void MainWindow::Impl::wire() {
  MainWindow* w = &window;
  QObject::connect(object, &ObjectDock::edited, w, [this](const Object& o) {
    Experiment e = session.experiment();
    e.object = o;
    if (o.kind == ObjectKind::Parallel) e.coupling.reset();
    else if (!e.coupling) e.coupling = Coupling{600, 0};
    edit(e, QStringLiteral("object"), [this](const QStringList& f) { object->setFaults(f); });
  });
  QObject::connect(coupling, &CouplingDock::edited, w, [this](const Coupling& c) {
    Experiment e = session.experiment();
    e.coupling = c;
    edit(e, QStringLiteral("coupling"), [this](const QStringList& f) { coupling->setFaults(f); });
  });
  QObject::connect(task, &TaskDock::edited, w, [this](const Task& t) {
    Experiment e = session.experiment();
    e.task = t;
    edit(e, QStringLiteral("task"), [this](const QStringList& f) { task->setFaults(f); });
  });
  QObject::connect(constraint, &ConstraintDock::shapeMoved, w, [this](const std::map<std::string, double>& shape) {
    Experiment e = session.experiment();
    e.constraint.shape = shape;
    edit(e, QStringLiteral("shape"), [this](const QStringList& f) { constraint->setFaults(f); });
  });
  QObject::connect(constraint, &ConstraintDock::chooseRequested, w, &MainWindow::chooseConstraint);
  QObject::connect(dock, &SessionDock::nextRequested, w, [this] { next(); });
  QObject::connect(dock, &SessionDock::abortRequested, w, [this] { session.abort(); });
  QObject::connect(dock, &SessionDock::repeatRequested, w, [this] {
    if (session.repeat()) showStage(), showOverlay();
  });
  QObject::connect(dock, &SessionDock::endRequested, w, [this] { session.endRun(); });
  QObject::connect(dock, &SessionDock::noteWritten, w, [this](const QString& text) { session.note(text); });
  QObject::connect(dock, &SessionDock::deviceChanged, w, [this] { showOverlay(); });
  QObject::connect(predictions, &PredictionDock::chosenChanged, w, [this] { drawPredictions(); });
  QObject::connect(view, &SceneView::handDragged, w, [this](double x, double y, double z) { session.pointTo(x, y, z); });
  QObject::connect(&session, &SessionController::experimentChanged, w, [this] { showExperiment(); });
  QObject::connect(&session, &SessionController::runOpened, w, [this] { runOpened(); });
  QObject::connect(&session, &SessionController::runClosed, w, [this] {
    nextPlanned = false;
    rate->setText(QStringLiteral("no run is open"));
    showStage();
    showOverlay();
  });
  QObject::connect(&session, &SessionController::trialBegun, w, [this] { showStage(); });
  QObject::connect(&session, &SessionController::trialEnded, w, [this] { trialEnded(); });
  QObject::connect(&session, &SessionController::failed, w, [this](const QString& sentence) { say(sentence); });
  timer = new QTimer(w);
  timer->setTimerType(Qt::PreciseTimer);
  QObject::connect(timer, &QTimer::timeout, w, [this] { oneFrame(); });
  timer->start(kFrameMs);
}

MainWindow::MainWindow(const SessionRequest& request, QWidget* parent) : QMainWindow(parent), impl_(std::make_unique<Impl>(*this, request)) {
  setObjectName(QStringLiteral("reachlab"));
  resize(1560, 960);
  impl_->makeDocks();
  impl_->makeStatusBar();
  impl_->makeMenus();
  impl_->dock->setRequest([&] {
    SessionRequest shown = request;
    if (!impl_->session.isPlan() && !shown.trials) shown.trials = 20;
    return shown;
  }());
  impl_->wire();
  impl_->showExperiment();
}

MainWindow::~MainWindow() {
  impl_->timer->stop();
  impl_->stopComputing.request_stop();
  delete impl_->subject;
}

SessionController& MainWindow::session() { return impl_->session; }
SceneView& MainWindow::view() { return *impl_->view; }
VelocityPlot& MainWindow::plot() { return *impl_->plot; }
PredictionDock& MainWindow::predictions() { return *impl_->predictions; }
SessionDock& MainWindow::sessionDock() { return *impl_->dock; }
OverlayState MainWindow::overlay() const { return impl_->overlay; }
QString MainWindow::message() const { return impl_->message->isHidden() ? QString() : impl_->message->text(); }
bool MainWindow::predictionsReady() const { return !impl_->forecastsStale && !impl_->computing.valid(); }

void MainWindow::nextTrial() { impl_->next(); }

ConstraintChooser& MainWindow::chooser() {
  if (impl_->chooser == nullptr) {
    impl_->chooser = new ConstraintChooser(this);
    connect(impl_->chooser, &ConstraintChooser::used, this, [this](const ConstraintChoice& choice) {
      Experiment e = impl_->session.experiment();
      e.constraint = choice.spec;
      if (!e.task) e.task = Task{};
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
  impl_->subject = new SubjectWindow;
  impl_->subject->setAttribute(Qt::WA_DeleteOnClose);
  connect(impl_->subject, &SubjectWindow::closed, this, [this] { impl_->subject = nullptr; });
  SceneView& view = impl_->subject->view();
  connect(&view, &SceneView::handDragged, this, [this](double x, double y, double z) { impl_->session.pointTo(x, y, z); });
  view.setPlan(planScene(impl_->session.experiment(), impl_->session.constraint(), impl_->viewOptions));
  view.setOverlay(impl_->overlay);
  impl_->subject->showFull();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  impl_->session.endRun();  // an unfinished trial is kept as interrupted
  if (impl_->subject != nullptr) impl_->subject->close();
  QMainWindow::closeEvent(event);
}

}  // namespace reachlab
