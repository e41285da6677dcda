#include "gui/app/main_window.h"

#include <QAbstractSpinBox>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDesktopServices>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLineEdit>
#include <QSettings>
#include <QStatusBar>
#include <QTabBar>
#include <QTableView>
#include <QTabWidget>
#include <QTimer>
#include <QUrl>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "gui/app/key_focus.h"
#include "gui/session/remembered_session.h"
#include "gui/plan/start_page.h"
#include "gui/plot/criterion_style.h"
#include "gui/session/session_overlay.h"
#include "gui/widgets/fault_in.h"
#include "gui/widgets/named.h"
#include "gui/widgets/work_strip.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::app {
namespace {

constexpr int kFrameMs = 16;          // 60 Hz
constexpr int kSoftwareFrameMs = 33;  // 30 Hz where the processor draws
constexpr int kStatusMs = 200;
constexpr int kLayoutMs = 500;  // from a change of the layout until it is remembered

enum class Stage { Closed, BetweenTrials, UnderWay, BlockDone, Finished, Following };

// BlockDone: the plan has a next block. Following: another station conducts.
Stage stageOf(SessionController& session) {
  const session::RecordedRun* run = session.run();
  return session.observes()         ? Stage::Following
         : run == nullptr           ? Stage::Closed
         : session.underWay()       ? Stage::UnderWay
         : session.follows()        ? Stage::Following
         : run->trialsLeft() > 0    ? Stage::BetweenTrials
         : session.blocksLeft() > 0 ? Stage::BlockDone
                                    : Stage::Finished;
}

std::string programmeName(const SessionController& session) {
  return session.isPlan() ? session.programme().plan.name : session.experiment().name;
}

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
  setObjectName("reachlab");
  setAcceptDrops(true);
  const QString what = QString::fromStdString(request.what);
  edits_.setOpened({what, QFileInfo::exists(what) ? what : QString()});
  words_.setLanguage(QSettings().value("subject/language", "en").toString());
  addCentre();
  docks_ = docks::makeDocks(*this, station.has_value());
  if (station) screens_->setOwnHand(station->link.station - 1);
  docks_.session->setRequest(request);
  status_ = std::make_unique<StatusLine>(*statusBar());
  actions_ = addMenus(*this);
  view_->addAction(actions_.next);
  strip_ = new SessionStrip(actions_.next, actions_.abort, actions_.repeat, actions_.end);
  addToolBar(strip_);
  screens_->setSubjectsActions({actions_.next, actions_.abort, actions_.repeat, actions_.end, actions_.subjectsScreen});
  new KeyFocus(*this, *view_);
  plans_ = new PlanPages(session_, *docks_.session, *view_);
  connect(screens_, &Screens::said, this, &MainWindow::say);
  connect(screens_, &Screens::placeChosen, this, &MainWindow::movePlace);
  connect(screens_, &Screens::optionsChanged, this, &MainWindow::showOverlay);
  auto* reading = new widgets::WorkStrip("readingScene", tr("Cancel"));
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
  auto* layout = widgets::filling<QVBoxLayout>(middle, 0);
  view_ = widgets::named<scene::SceneView>("scene");
  pages_ = widgets::named<QTabWidget>("pages");
  pages_->setDocumentMode(true);
  pages_->tabBar()->setExpanding(false);
  pages_->addTab(view_, tr("Reach"));
  auto* page = new QWidget;
  widgets::filling<QVBoxLayout>(page);
  pages_->addTab(page, tr("Inspect"));
  layout->addWidget(pages_, 1);
  setCentralWidget(middle);
  messages_ = new widgets::Messages(*middle);
  card_ = new widgets::Card(*view_);
  connect(pages_, &QTabWidget::currentChanged, this, [this](int now) { switchLayout(now == 1 ? WindowLayout::Inspect : reachLayout_); });
  screens_ = new Screens(*view_);
  screens_->setParent(this);
}

void MainWindow::wireDocks() {
  for (docks::Dock* dock : docks_.all)
    connect(dock, &docks::Dock::edited, this,
            [this, dock](const experiment::Experiment& changed, const QString& what) { tryEdit(*dock, changed, what); });
  docks::SessionDock* dock = docks_.session;
  connect(strip_, &SessionStrip::noteWritten, this, [this](const QString& text) { session_.note(text); });
  connect(dock, &docks::SessionDock::changed, this, [this] {
    docks_.devices->setHand(QString::fromStdString(docks_.session->device()));
    if (docks_.session->fault().isEmpty()) rememberRequest(docks_.session->request());
    showOverlay();
  });
  connect(dock, &docks::SessionDock::devicesRequested, this, [this] {
    docks_.devices->show();
    docks_.devices->raise();
  });
  connect(docks_.devices, &docks::DeviceDock::taken, dock, &docks::SessionDock::setDevice);
  docks_.devices->setHand(QString::fromStdString(dock->device()));
  connect(docks_.trials, &docks::TrialsDock::noteRequested, this,
          [this](int number) { strip_->beginNote(QStringLiteral("trial %1: ").arg(number)); });
  connect(docks_.trials, &docks::TrialsDock::markRequested, this, &MainWindow::markTrial);
  connect(docks_.trials, &docks::TrialsDock::takeBackRequested, this, [this] {
    if (!session_.takeBackRepeat()) return warn(tr("No repeat is planned."));
    showStage();
    if (stageOf(session_) == Stage::Finished) showEnd();
  });
  connect(&plans_->startPage(), &plan::StartPage::beginRequested, this, [this] {
    session_.beginAnew();
    beginNext();
  });
  connect(&plans_->startPage(), &plan::StartPage::resumeRequested, this, &MainWindow::resumeSession);
  connect(&plans_->startPage(), &plan::StartPage::composeRequested, this, &MainWindow::composePlan);
  connect(plans_, &PlanPages::composed, this, &MainWindow::openExperiment);
  connect(docks_.signal, &plot::SignalPlot::watchedChanged, this, [this](int mass) { session_.watch(mass); });
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
  connect(&runFits_, &inspector::Inspector::fitted, this,
          [this](const std::vector<std::optional<double>>& epsilons) { predictions().setFitted(epsilons); });
  // One fit after the other: that of a long run takes longer than a trial, and many under way at once would take memory for each.
  connect(&runFits_, &inspector::Inspector::idle, this, [this] {
    if (std::exchange(fitAgain_, false)) runFits_.fit({{fitted_, succeeded_}});
  });
  session_.setOwnPause([this] { return docks_.session->ownPause(); });
  connect(&session_, &SessionController::experimentChanged, this, &MainWindow::showExperiment);
  connect(&session_, &SessionController::runOpened, this, &MainWindow::runOpened);
  connect(&session_, &SessionController::runClosed, this, &MainWindow::runClosed);
  connect(&session_, &SessionController::trialBegun, this, &MainWindow::showStage);
  connect(&session_, &SessionController::trialEnded, this, &MainWindow::trialEnded);
  if (docks_.stations != nullptr) connect(&session_, &SessionController::stationTold, docks_.stations, &docks::StationsDock::tell);
  using Words = void (SessionController::*)(const QString&);
  for (const auto& [words, show] : {std::pair<Words, void (MainWindow::*)(const QString&)>{&SessionController::told, &MainWindow::warn},
                                    {&SessionController::failed, &MainWindow::say},
                                    {&SessionController::done, &MainWindow::tell}}) {
    connect(&session_, words, this, show);
    connect(&session_, words, this, &MainWindow::showStage);  // where nothing was armed it may be asked again
  }
  connect(&edits_.stack(), &QUndoStack::canUndoChanged, this, &MainWindow::showStage);
  connect(&edits_.stack(), &QUndoStack::canRedoChanged, this, &MainWindow::showStage);
  connect(&edits_.stack(), &QUndoStack::cleanChanged, this, [this](bool clean) { setWindowModified(!clean); });
  timer_ = new QTimer(this);
  timer_->setTimerType(Qt::PreciseTimer);
  connect(timer_, &QTimer::timeout, this, &MainWindow::oneFrame);
  timer_->start(view_->drawsInSoftware() ? kSoftwareFrameMs : kFrameMs);
  auto* slowTimer = new QTimer(this);
  connect(slowTimer, &QTimer::timeout, this, [this] {
    if (session_.run() != nullptr) status_->refresh(*session_.run());
    plans_->refresh();
    if (session_.run() == nullptr) showOverlay();  // another subject may begin with another block
    showStations();
  });
  slowTimer->start(kStatusMs);
  layoutTimer_ = new QTimer(this);
  layoutTimer_->setSingleShot(true);
  layoutTimer_->setInterval(kLayoutMs);
  connect(layoutTimer_, &QTimer::timeout, this, [this] {
    if (isVisible()) rememberLayout(*this, layout_);
  });
  for (docks::Dock* dock : docks_.all) {
    connect(dock, &QDockWidget::visibilityChanged, layoutTimer_, QOverload<>::of(&QTimer::start));
    connect(dock, &QDockWidget::topLevelChanged, layoutTimer_, QOverload<>::of(&QTimer::start));
    connect(dock, &QDockWidget::topLevelChanged, this, [this, dock](bool floats) {  // over the scene, and over no other dock
      if (floats && QGuiApplication::mouseButtons() == Qt::NoButton) dock->move(view_->mapToGlobal(QPoint(40, 40)));
    });
    connect(dock, &QDockWidget::dockLocationChanged, layoutTimer_, QOverload<>::of(&QTimer::start));
  }
}

void MainWindow::showExperiment() {
  const experiment::CompiledExperiment& compiled = session_.compiled();
  for (docks::Dock* dock : docks_.all) dock->showExperiment(compiled, !session_.isPlan());
  const auto& task = compiled.experiment().task;
  trace_.setPath(task ? constraints::TaskPath(compiled.constraint(), task->start, task->target) : constraints::TaskPath());
  screens_->lookIn(QFileInfo(edits_.opened().file).path());
  screens_->showExperiment(compiled, session_.blockPlaces());
  plans_->refresh();
  showOverlay();
  forecast_.setExperiment(compiled);
  showStage();  // a plan's places are not moved
  showTitle(*this, QString::fromStdString(programmeName(session_)));
}

void MainWindow::showOverlay() {
  const bool mouse = docks_.session->device() == "mouse";
  screens_->showOverlay(overlayOf(session_, mouse, screens_->massesHide()),
                        subjectsOverlayOf(session_, words_, score_, plans_->startPage().instructions()));
}

void MainWindow::showStage() {
  const Stage stage = stageOf(session_);
  docks_.session->setOpen(stage != Stage::Closed);
  docks_.devices->setBusy(stage != Stage::Closed);
  strip_->setOpen(session_.run() != nullptr);
  actions_.next->setText(stage == Stage::Closed ? tr("&Start") : stage == Stage::BlockDone ? tr("&Next block") : tr("&Next trial"));
  // The keys do what the buttons do: a key that went astray begins no new run where one is over, or while a recording is looked at.
  actions_.next->setEnabled(stage != Stage::UnderWay && stage != Stage::Finished && stage != Stage::Following && !inspecting());
  actions_.abort->setEnabled(stage == Stage::UnderWay);
  for (QAction* action : {actions_.repeat, actions_.end})
    action->setEnabled(stage != Stage::UnderWay && stage != Stage::Closed && !inspecting());
  if (stage == Stage::Following) actions_.repeat->setEnabled(false);
  actions_.nextSubject->setEnabled(stage == Stage::Closed && !inspecting());
  actions_.undo->setEnabled(edits_.stack().canUndo() && !inspecting());  // the experiment is not seen there
  actions_.redo->setEnabled(edits_.stack().canRedo() && !inspecting());
  view_->setPlacesMovable(stage == Stage::Closed && !session_.isPlan());
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

void MainWindow::drawPredictions() {
  const std::vector<predict::Criterion> chosen = predictions().chosen();
  plot().setPredictions(forecast_.lines(chosen));
  const predict::Criterion first = chosen.empty() ? predict::Criterion::MinHandJerk : chosen.front();
  docks_.trials->showCriterion(static_cast<std::size_t>(first), plot::titleOf(first));
}

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
  if (stageOf(session_) == Stage::Finished) showEnd();
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

docks::ConstraintChooser& MainWindow::chooser() { return docks_.constraint->chooser(); }

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
  if (stageOf(session_) == Stage::Finished) session_.endRun();  // what is left is seen on the disk
  if (session_.run() == nullptr) takeEntry();
  session_.resume();
  beginNext();
}

QString MainWindow::dataFolder() const {
  return QFileInfo(QString::fromStdString(docks_.session->request().place.data)).absoluteFilePath();
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
  widgets::quietly(pages_)->setCurrentIndex(inspecting() ? 1 : 0);
  if (inspecting() && inspector().path().isEmpty())  // what this session records
    if (const QString folder = QString::fromStdString(docks_.session->request().place.data); QFileInfo(folder).isDir())
      inspector().open(folder);
  if (inspecting()) inspector().view().setFocus();  // for the keys of the replay
  else view_->setFocus();
  const QString name = inspecting() ? QFileInfo(inspector().path()).fileName() : QString::fromStdString(programmeName(session_));
  showTitle(*this, name.isEmpty() ? tr("recordings") : name);
  showStage();
}

void MainWindow::openManual() {
  const QString page = manualPage();
  if (page.isEmpty() || !QDesktopServices::openUrl(QUrl::fromLocalFile(page)))
    say(page.isEmpty() ? "The manual is not installed. Install the package reachlab-doc."
                       : QStringLiteral("No program opens the manual. Open this file in a browser: %1").arg(page));
}

void MainWindow::composePlan() { plans_->compose(this, edits_.opened().file); }
void MainWindow::chooseConstraint() { docks_.constraint->choose(); }

void MainWindow::setSubjectsLanguage(const QString& code) {
  words_.setLanguage(code);
  QSettings().setValue("subject/language", words_.language());
  showOverlay();
}

void MainWindow::say(const QString& sentence) {
  if (sentence.isEmpty()) messages_->clear();
  messages_->say(widgets::Grade::Error, sentence);
}
void MainWindow::warn(const QString& sentence) { messages_->say(widgets::Grade::Attention, sentence); }
void MainWindow::tell(const QString& sentence) { messages_->say(widgets::Grade::Done, sentence); }

}  // namespace reachlab::gui::app
