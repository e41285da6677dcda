#include "gui/app/main_window.h"

#include <QAction>
#include <QDesktopServices>
#include <QFileInfo>
#include <QSettings>
#include <QSignalBlocker>
#include <QStatusBar>
#include <QTabBar>
#include <QTableView>
#include <QTabWidget>
#include <QTimer>
#include <QUrl>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "base/system/error_report.h"
#include "gui/app/key_focus.h"
#include "gui/app/screens.h"
#include "gui/app/window_layout.h"
#include "gui/docks/constraint_dock.h"
#include "gui/docks/device_dock.h"
#include "gui/docks/prediction_dock.h"
#include "gui/docks/session_dock.h"
#include "gui/docks/signal_dock.h"
#include "gui/docks/stations_dock.h"
#include "gui/docks/trials_dock.h"
#include "gui/docks/velocity_dock.h"
#include "gui/inspector/epsilon_panel.h"
#include "gui/inspector/inspector.h"
#include "gui/plot/criterion_style.h"
#include "gui/plot/signal_point.h"
#include "gui/scene/scene_view.h"
#include "gui/session/plan_pages.h"
#include "gui/session/session_overlay.h"
#include "gui/session/trial_marking.h"
#include "gui/widgets/message_bar.h"
#include "gui/widgets/work_strip.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::app {
namespace {

constexpr int kFrameMs = 16;          // 60 Hz
constexpr int kSoftwareFrameMs = 33;  // 30 Hz where the processor draws
constexpr int kStatusMs = 200;

void showTitle(MainWindow& window, const QString& name) {
  const network::StationSetup* station = window.session().station();
  const QString what = station == nullptr            ? name
                       : window.session().observes() ? MainWindow::tr("%1, observing").arg(name)
                                                     : MainWindow::tr("%1, station %2").arg(name).arg(station->link.station);
  window.setWindowTitle(QStringLiteral("%1[*] – Reachlab").arg(what));
}

}  // namespace

MainWindow::MainWindow(const session::SessionRequest& request, const std::optional<network::StationSetup>& station, QWidget* parent)
    : QMainWindow(parent), session_(request, station), edits_(session_) {
  setObjectName(QStringLiteral("reachlab"));
  setAcceptDrops(true);
  if (QFileInfo::exists(QString::fromStdString(request.what))) file_ = QString::fromStdString(request.what);
  words_.setLanguage(QSettings().value(QStringLiteral("subject/language"), QStringLiteral("en")).toString());
  addCentre();
  docks_ = docks::makeDocks(*this, station.has_value());
  if (station) screens_->setOwnHand(station->link.station - 1);
  docks_.session->setRequest(request);
  status_ = std::make_unique<StatusLine>(*statusBar());
  actions_ = addMenus(*this);
  screens_->setSubjectsActions({actions_.next, actions_.abort, actions_.repeat, actions_.end, actions_.subjectsScreen});
  new KeyFocus(*this, *view_);
  plans_ = new PlanPages(session_, *docks_.session, *view_);
  if (!file_.isEmpty()) screens_->lookIn(QFileInfo(file_).path());
  connect(screens_, &Screens::said, this, &MainWindow::say);
  auto* reading = new widgets::WorkStrip(QStringLiteral("readingScene"), tr("Cancel"));
  statusBar()->addPermanentWidget(reading);
  model::ModelReader& reader = screens_->modelReader();
  connect(&reader, &model::ModelReader::progressed, reading, &widgets::WorkStrip::tell);
  connect(&reader, &model::ModelReader::idle, reading, &QWidget::hide);
  connect(&reading->button(), &QToolButton::clicked, &reader, &model::ModelReader::cancel);
  wireDocks();
  wireSession();
  stackOnNarrowScreen(*this);
  firstLayout_ = saveState();
  layout_ = restoreLayout(*this);
  if (inspecting()) switchLayout(WindowLayout::SetUp);                                // nothing is open yet
  if (docks_.stations != nullptr) docks_.stations->show(), docks_.stations->raise();  // whatever windows without it have remembered
  showExperiment();
  showStage();
  view_->setFocus();
}

MainWindow::~MainWindow() {
  if (QWidget* field = focusWidget()) field->clearFocus();  // an entry is taken when its field is left: while there is who takes it
  timer_->stop();
}

void MainWindow::addCentre() {
  auto* middle = new QWidget;
  auto* layout = new QVBoxLayout(middle);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  message_ = new MessageBar;
  layout->addWidget(message_);
  view_ = new scene::SceneView;
  view_->setObjectName(QStringLiteral("scene"));
  pages_ = new QTabWidget;
  pages_->setObjectName(QStringLiteral("pages"));
  pages_->setDocumentMode(true);
  pages_->tabBar()->setExpanding(false);
  pages_->addTab(view_, tr("Reach"));
  auto* page = new QWidget;
  (new QVBoxLayout(page))->setContentsMargins(0, 0, 0, 0);
  pages_->addTab(page, tr("Inspect"));
  layout->addWidget(pages_, 1);
  setCentralWidget(middle);
  connect(pages_, &QTabWidget::currentChanged, this, [this](int now) { switchLayout(now == 1 ? WindowLayout::Inspect : reachLayout_); });
  screens_ = new Screens(*view_);
  screens_->setParent(this);
}

void MainWindow::wireDocks() {
  for (docks::Dock* dock : docks_.all)
    connect(dock, &docks::Dock::edited, this,
            [this, dock](const experiment::Experiment& changed, const QString& what) { tryEdit(*dock, changed, what); });
  docks::SessionDock* dock = docks_.session;
  connect(dock, &docks::SessionDock::nextRequested, this, &MainWindow::nextTrial);
  connect(dock, &docks::SessionDock::abortRequested, this, &MainWindow::abortTrial);
  connect(dock, &docks::SessionDock::repeatRequested, this, &MainWindow::repeatTrial);
  connect(dock, &docks::SessionDock::endRequested, this, &MainWindow::endRun);
  connect(dock, &docks::SessionDock::noteWritten, this, [this](const QString& text) { session_.note(text); });
  connect(dock, &docks::SessionDock::deviceChanged, this, [this] {
    docks_.devices->setHand(QString::fromStdString(docks_.session->device()));
    showOverlay();
  });
  connect(dock, &docks::SessionDock::devicesRequested, this, [this] {
    docks_.devices->show();
    docks_.devices->raise();
  });
  connect(docks_.devices, &docks::DeviceDock::taken, dock, &docks::SessionDock::setDevice);
  docks_.devices->setHand(QString::fromStdString(dock->device()));
  connect(docks_.trials, &docks::TrialsDock::noteRequested, this,
          [this](int number) { docks_.session->beginNote(QStringLiteral("trial %1: ").arg(number)); });
  wireMarking(*docks_.trials, session_, *message_);
  connect(plans_, &PlanPages::beginRequested, this, [this] {
    session_.beginAnew();
    beginNext();
  });
  connect(plans_, &PlanPages::resumeRequested, this, &MainWindow::resumeSession);
  connect(plans_, &PlanPages::composeRequested, this, &MainWindow::composePlan);
  connect(plans_, &PlanPages::composed, this, &MainWindow::openExperiment);
  connect(&docks_.signal->plot(), &plot::SignalPlot::watchedChanged, this, [this](int mass) { session_.watch(mass); });
  connect(docks_.predictions, &docks::PredictionDock::chosenChanged, this, &MainWindow::drawPredictions);
}

void MainWindow::wireSession() {
  connect(screens_, &Screens::handDragged, this, [this](double x, double y, double z, qint64 eventMs) {
    session_.pointTo({x, y, z}, eventMs);
  });
  connect(&forecast_, &plot::LiveForecast::changed, this, [this] {
    predictions().setForecasts(forecast_.forecasts());
    drawPredictions();
  });
  connect(&forecast_, &plot::LiveForecast::compared, this, [this](const std::vector<std::optional<double>>& errors, bool succeeded) {
    predictions().addErrors(errors, succeeded);
    docks_.trials->setErrors(errors);
  });
  connect(&runFits_, &inspector::Inspector::judged, this, [this](const std::shared_ptr<const inspector::Inspection>& run) {
    std::vector<std::optional<double>> fitted;
    for (int i = 0; i < predict::kCriterionCount; ++i)
      fitted.push_back(inspector::fittedEpsilon(*run->analysis, 0, static_cast<predict::Criterion>(i)));
    predictions().setFitted(fitted);
  });
  session_.setOwnPause([this] {
    const docks::SessionDock& dock = *docks_.session;
    return dock.repeatsByItself() ? std::optional(dock.pauseSeconds()) : std::nullopt;
  });
  connect(&session_, &SessionController::experimentChanged, this, &MainWindow::showExperiment);
  connect(&session_, &SessionController::runOpened, this, &MainWindow::runOpened);
  connect(&session_, &SessionController::runClosed, this, &MainWindow::runClosed);
  connect(&session_, &SessionController::trialBegun, this, &MainWindow::showStage);
  connect(&session_, &SessionController::trialEnded, this, &MainWindow::trialEnded);
  if (docks_.stations != nullptr) connect(&session_, &SessionController::stationTold, docks_.stations, &docks::StationsDock::tell);
  for (const auto& sentence : {&SessionController::told, &SessionController::failed})
    connect(&session_, sentence, this, [this](const QString& words) {
      message_->say(words);
      showStage();  // where nothing was armed it may be asked again
    });
  connect(&edits_.stack(), &QUndoStack::cleanChanged, this, [this](bool clean) { setWindowModified(!clean); });
  timer_ = new QTimer(this);
  timer_->setTimerType(Qt::PreciseTimer);
  connect(timer_, &QTimer::timeout, this, &MainWindow::oneFrame);
  connect(&analysis_, &DatasetAnalysis::said, this, [this](const QString& words) { message_->say(words); });
  connect(&analysis_, &DatasetAnalysis::told, this, [this](const QString& words) { message_->tell(words); });
  connect(&analysis_, &DatasetAnalysis::reported, this, [](const QString& page) { QDesktopServices::openUrl(QUrl::fromLocalFile(page)); });
  timer_->start(view_->drawsInSoftware() ? kSoftwareFrameMs : kFrameMs);
  auto* slowTimer = new QTimer(this);
  connect(slowTimer, &QTimer::timeout, this, [this] {
    if (session_.run() != nullptr) status_->refresh(*session_.run());
    plans_->refresh();
    showStations();
  });
  slowTimer->start(kStatusMs);
}

void MainWindow::showExperiment() {
  const experiment::CompiledExperiment& compiled = session_.compiled();
  for (docks::Dock* dock : docks_.all) dock->showExperiment(compiled, !session_.isPlan());
  const auto& task = compiled.experiment().task;
  trace_.setPath(task ? constraints::TaskPath(compiled.constraint(), task->start, task->target) : constraints::TaskPath());
  screens_->showExperiment(compiled);
  showOverlay();
  plans_->refresh();
  forecast_.setExperiment(compiled);
  showTitle(*this, QString::fromStdString(compiled.experiment().name));
}

void MainWindow::showOverlay() {
  const bool mouse = docks_.session->device() == "mouse";
  screens_->showOverlay(overlayOf(session_, mouse, screens_->massesHide()), subjectsOverlayOf(session_, words_, score_));
}

void MainWindow::showStage() {
  using Stage = docks::SessionDock::Stage;
  const session::RecordedRun* run = session_.run();
  const Stage stage = session_.observes()         ? Stage::Following
                      : run == nullptr            ? Stage::Closed
                      : session_.underWay()       ? Stage::UnderWay
                      : session_.follows()        ? Stage::Following
                      : run->trialsLeft() > 0     ? Stage::BetweenTrials
                      : session_.blocksLeft() > 0 ? Stage::BlockDone
                                                  : Stage::Finished;
  docks_.session->setStage(stage);
  docks_.devices->setBusy(stage != Stage::Closed);
  // The keys do what the buttons do: a key that went astray begins no new run where one is over, or while a recording is looked at.
  actions_.next->setEnabled(stage != Stage::UnderWay && stage != Stage::Finished && stage != Stage::Following && !inspecting());
  actions_.abort->setEnabled(stage == Stage::UnderWay);
  for (QAction* action : {actions_.repeat, actions_.end})
    action->setEnabled(stage != Stage::UnderWay && stage != Stage::Closed && !inspecting());
  if (stage == Stage::Following) actions_.repeat->setEnabled(false);
}

void MainWindow::drawPredictions() {
  const std::vector<predict::Criterion> chosen = predictions().chosen();
  plot().setPredictions(forecast_.lines(chosen));
  const predict::Criterion first = chosen.empty() ? predict::Criterion::MinHandJerk : chosen.front();
  docks_.trials->showCriterion(static_cast<std::size_t>(first), plot::titleOf(first));
}

void MainWindow::runOpened() {
  const session::RecordedRun& run = *session_.run();
  docks_.session->clearTally();
  docks_.signal->plot().clear();
  lastNs_ = 0;
  score_ = 0;
  succeeded_.clear();
  runFits_.cancel();
  docks_.session->showRun(run.configuration());
  predictions().clearErrors();
  docks_.trials->clear();
  trace_.beginRun();
  status_->runOpened(run);
  plans_->refresh();
  showStage();
}

void MainWindow::runClosed() {
  status_->runClosed();
  plans_->refresh();
  screens_->showRest();
  showStage();
  showOverlay();
}

void MainWindow::drainTrace() {
  for (plot::TracePoint point; session_.tryTake(point);) {
    trace_.add(point, plot());
    docks_.signal->plot().add(plot::signalPointOf(point, std::exchange(lastNs_, point.measuredNs)));
  }
}

void MainWindow::trialEnded() {
  drainTrace();  // to its last point
  const trial::TrialResult result = session_.lastTrial()->result;
  docks_.session->count(result);
  if (session_.run() != nullptr) docks_.trials->add(session_.run()->numberOf(*session_.lastTrial()), result);
  if (result.outcome == trial::Outcome::Success) ++score_, sounds_.play(SoundCues::Cue::Success);
  if (result.outcome == trial::Outcome::Failure) sounds_.play(SoundCues::Cue::Failure);
  if (result.outcome == trial::Outcome::Success || result.outcome == trial::Outcome::Failure)
    forecast_.compare(trace_.points(), trace_.path(), {session_.run()->configuration().sampleEveryTicks, result.onsetTick, result.endTick},
                      result.outcome == trial::Outcome::Success);
  if (result.outcome == trial::Outcome::Success && session_.run() != nullptr) fitRun();
  showStage();
}

// What `reach analyze` would fit if the run ended here: the same rows, the same code.
void MainWindow::fitRun() {
  succeeded_.push_back(session_.run()->numberOf(*session_.lastTrial()));
  if (succeeded_.size() < analysis::kFewestTrials || session_.run()->configuration().practice) return;
  runFits_.begin({{session_.run()->logPath(), succeeded_}});
}

void MainWindow::oneFrame() {
  session_.poll();
  drainTrace();
  forecast_.poll();
  if (session_.takeNextTrial()) nextTrial();
  if (const haptics::TickState* seen = session_.seen()) {
    screens_->showState(*seen, session_.otherHands());
    showOverlay();
  }
  if (session_.run() == nullptr) return;
  screens_->showState(session_.run()->latest(), session_.otherHands());
  playGo(session_.run()->latest());
  showOverlay();
  plot().refresh();
  docks_.signal->plot().refresh();
}

void MainWindow::joinStations() {
  try {
    session_.join(docks_.session->request());
  } catch (const std::exception& e) {
    message_->say(QString::fromStdString(errorReportOf(e).sentence));
  }
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

plot::VelocityPlot& MainWindow::plot() { return docks_.velocity->plot(); }
docks::ConstraintChooser& MainWindow::chooser() { return docks_.constraint->chooser(); }
const scene::OverlayState& MainWindow::overlay() const { return screens_->overlay(); }
QString MainWindow::message() const { return message_->sentence(); }

void MainWindow::nextTrial() {
  if (session_.run() == nullptr && plans_->resumes()) session_.resume();
  beginNext();
}

void MainWindow::beginNext() {
  session_.cancelPause();
  if (session_.restLeft() > 0)
    return message_->tell(tr("The plan rests %1 s more before its next block; Ctrl+E ends this block's run and the rest.")
                              .arg(std::ceil(session_.restLeft())));
  if (session_.run() == nullptr && !docks_.session->fault().isEmpty()) return message_->say(docks_.session->fault());
  try {
    message_->say({});
    if (!session_.next(docks_.session->request()) && session_.run() == nullptr) message_->tell(QStringLiteral("The session is complete."));
  } catch (const std::exception& e) {
    message_->say(QString::fromStdString(errorReportOf(e).sentence));
  }
  showStage();
}

void MainWindow::abortTrial() {
  session_.abort();
  showStage();  // a trial that was not armed yet has no end
}

void MainWindow::repeatTrial() {
  if (session_.repeat()) showStage(), showOverlay();
}

void MainWindow::resumeSession() {
  session_.resume();
  beginNext();
}

void MainWindow::endRun() { session_.endRun(); }

void MainWindow::resetLayout() {
  forgetLayout();
  (void)restoreState(firstLayout_);
}

void MainWindow::switchLayout(WindowLayout layout) {
  rememberDocks(*this, layout_);
  layout_ = layout;
  if (!inspecting()) reachLayout_ = layout;
  (void)restoreState(firstLayout_);
  restoreDocks(*this, layout_);
  showPage();
}

void MainWindow::showPage() {
  const QSignalBlocker quiet(pages_);
  pages_->setCurrentIndex(inspecting() ? 1 : 0);
  if (inspecting() && inspector().path().isEmpty())  // what this session records
    if (const QString folder = QString::fromStdString(docks_.session->request().place.data); QFileInfo(folder).isDir())
      inspector().open(folder);
  if (inspecting()) inspector().view().setFocus();  // for the keys of the replay
  else view_->setFocus();
  const QString name = inspecting() ? QFileInfo(inspector().path()).fileName() : QString::fromStdString(session_.experiment().name);
  showTitle(*this, name.isEmpty() ? tr("recordings") : name);
  showStage();
}

void MainWindow::openManual() {
  const QString page = manualPage();
  if (page.isEmpty() || !QDesktopServices::openUrl(QUrl::fromLocalFile(page)))
    message_->say(page.isEmpty() ? QStringLiteral("The manual is not installed. Install the package reachlab-doc.")
                                 : QStringLiteral("No program opens the manual. Open this file in a browser: %1").arg(page));
}

void MainWindow::analyse(const QString& dataset) { analysis_.begin(dataset); }

void MainWindow::composePlan() { plans_->compose(this, file_); }
void MainWindow::chooseConstraint() { docks_.constraint->choose(); }
void MainWindow::toggleSubjectWindow() { screens_->toggleSubject(); }
void MainWindow::showSubjectOn(const QString& screen) { screens_->showSubjectOn(screen); }

void MainWindow::setSubjectsLanguage(const QString& code) {
  words_.setLanguage(code);
  QSettings().setValue(QStringLiteral("subject/language"), words_.language());
  showOverlay();
}

void MainWindow::say(const QString& sentence) { message_->say(sentence); }
void MainWindow::tell(const QString& sentence) { message_->tell(sentence); }

void MainWindow::setSideBySide(bool on) {
  screens_->setSideBySide(on);
  showOverlay();
}

void MainWindow::setMuted(bool muted) { sounds_.setMuted(muted); }

}  // namespace reachlab::gui::app
