#include "gui/app/main_window.h"

#include <QAction>
#include <QDesktopServices>
#include <QFileInfo>
#include <QGuiApplication>
#include <QSettings>
#include <QStatusBar>
#include <QTabBar>
#include <QTableView>
#include <QTabWidget>
#include <QTimer>
#include <QUrl>
#include <QVBoxLayout>
#include <utility>

#include "gui/app/key_focus.h"
#include "gui/plan/start_page.h"
#include "gui/plot/criterion_style.h"
#include "gui/session/remembered_session.h"
#include "gui/session/session_overlay.h"
#include "gui/session/session_stage.h"
#include "gui/widgets/named.h"
#include "gui/widgets/work_strip.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::app {
namespace {

constexpr int kFrameMs = 16;          // 60 Hz
constexpr int kSoftwareFrameMs = 33;  // 30 Hz where the processor draws
constexpr int kStatusMs = 200;
constexpr int kLayoutMs = 500;  // from a change of the layout until it is remembered

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
    if (stageOf(session_) == SessionStage::Finished) showEnd();
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
  const SessionStage stage = stageOf(session_);
  docks_.session->setOpen(stage != SessionStage::Closed);
  docks_.devices->setBusy(stage != SessionStage::Closed);
  strip_->setOpen(session_.run() != nullptr);
  actions_.next->setText(stage == SessionStage::Closed      ? tr("&Start")
                         : stage == SessionStage::BlockDone ? tr("&Next block")
                                                            : tr("&Next trial"));
  // The keys do what the buttons do: a key that went astray begins no new run where one is over, or while a recording is looked at.
  actions_.next->setEnabled(stage != SessionStage::UnderWay && stage != SessionStage::Finished && stage != SessionStage::Following &&
                            !inspecting());
  actions_.abort->setEnabled(stage == SessionStage::UnderWay);
  for (QAction* action : {actions_.repeat, actions_.end})
    action->setEnabled(stage != SessionStage::UnderWay && stage != SessionStage::Closed && !inspecting());
  if (stage == SessionStage::Following) actions_.repeat->setEnabled(false);
  actions_.nextSubject->setEnabled(stage == SessionStage::Closed && !inspecting());
  actions_.undo->setEnabled(edits_.stack().canUndo() && !inspecting());  // the experiment is not seen there
  actions_.redo->setEnabled(edits_.stack().canRedo() && !inspecting());
  view_->setPlacesMovable(stage == SessionStage::Closed && !session_.isPlan());
}

void MainWindow::drawPredictions() {
  const std::vector<predict::Criterion> chosen = predictions().chosen();
  plot().setPredictions(forecast_.lines(chosen));
  const predict::Criterion first = chosen.empty() ? predict::Criterion::MinHandJerk : chosen.front();
  docks_.trials->showCriterion(static_cast<std::size_t>(first), plot::titleOf(first));
}

docks::ConstraintChooser& MainWindow::chooser() { return docks_.constraint->chooser(); }

QString MainWindow::dataFolder() const {
  return QFileInfo(QString::fromStdString(docks_.session->request().place.data)).absoluteFilePath();
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
