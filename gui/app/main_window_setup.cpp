#include <QAction>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QSaveFile>
#include <QStatusBar>
#include <QTimer>
#include <QUndoStack>
#include <QVBoxLayout>

#include "base/error.h"
#include "gui/docks/constraint_dock.h"
#include "gui/docks/coupling_dock.h"
#include "gui/app/main_window_impl.h"
#include "gui/docks/object_dock.h"
#include "gui/docks/prediction_dock.h"
#include "gui/scene/scene_view.h"
#include "gui/docks/session_dock.h"
#include "gui/subject/subject_window.h"
#include "gui/docks/task_dock.h"
#include "gui/plot/velocity_plot.h"
#include "sim/dynamics/compiled_scene.h"

// Docks, menus and status bar of the main window, and what is connected to what.
namespace reachlab::gui::app {

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
  view = new scene::SceneView;
  view->setObjectName(QStringLiteral("scene"));
  layout->addWidget(view, 1);
  window.setCentralWidget(middle);

  plot = new plot::VelocityPlot;
  auto* plotDock = new QDockWidget(QStringLiteral("Velocity"), &window);
  plotDock->setObjectName(QStringLiteral("plotDock"));
  plotDock->setWidget(plot);
  object = new docks::ObjectDock(&window);
  coupling = new docks::CouplingDock(&window);
  task = new docks::TaskDock(&window);
  predictions = new docks::PredictionDock(&window);
  dock = new docks::SessionDock(&window);
  constraint = new docks::ConstraintDock(&window);
  window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  window.addDockWidget(Qt::BottomDockWidgetArea, plotDock);
  window.addDockWidget(Qt::LeftDockWidgetArea, dock);
  window.addDockWidget(Qt::LeftDockWidgetArea, constraint);
  window.addDockWidget(Qt::LeftDockWidgetArea, predictions);
  for (QDockWidget* d : std::initializer_list<QDockWidget*>{object, coupling, task}) window.addDockWidget(Qt::RightDockWidgetArea, d);
  window.resizeDocks({plotDock}, {270}, Qt::Vertical);
  window.resizeDocks({dock, object}, {378, 300}, Qt::Horizontal);
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
    const session::Programme opened = session::readProgramme(what.toStdString());
    for (const experiment::CompiledExperiment& experiment : opened.experiments) (void)dynamics::compileScene(experiment);
    const session::Programme before = session.programme();
    session.setProgramme(opened);
    pushEdit(before, QStringLiteral("open %1").arg(what));
    say({});
  } catch (const Error& e) {
    say(QString::fromUtf8(e.what()));
  }
}

void MainWindow::Impl::saveExperiment() {
  const QString file =
      QFileDialog::getSaveFileName(&window, QStringLiteral("Save experiment"), QString::fromStdString(session.experiment().name + ".json"),
                                   QStringLiteral("Experiments (*.json)"));
  if (file.isEmpty()) return;
  QSaveFile out(file);
  const std::string text = experiment::toJson(session.experiment());
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
    const QString chosen = QFileDialog::getOpenFileName(&window, QStringLiteral("Open experiment or plan"), {},
                                                        QStringLiteral("Experiments and plans (*.json)"));
    if (!chosen.isEmpty()) openExperiment(chosen);
  });
  QMenu* shipped = file->addMenu(QStringLiteral("S&hipped"));
  for (const std::string& name : experiment::shippedExperiments())
    add(shipped, QString::fromStdString(name), {}, [this, name] { openExperiment(QString::fromStdString(name)); });
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
  add(trial, QStringLiteral("Res&ume the session"), {}, [this] {
    session.resume();
    next();
  })->setObjectName(QStringLiteral("resume"));
  add(trial, QStringLiteral("&End run"), QKeySequence(QStringLiteral("Ctrl+E")), [this] { session.endRun(); });

  QMenu* show = window.menuBar()->addMenu(QStringLiteral("&View"));
  add(show, QStringLiteral("&Whole scene"), Qt::Key_Home, [this] { view->resetCamera(); });
  for (const char axis : {'x', 'y', 'z'})
    add(show, QStringLiteral("Along %1").arg(QLatin1Char(axis)),
        QKeySequence(QStringLiteral("Ctrl+%1").arg(axis == 'x'   ? 1
                                                   : axis == 'y' ? 2
                                                                 : 3)),
        [this, axis] { view->lookAlong(axis); });
  show->addSeparator();
  QAction* aside = add(show, QStringLiteral("&Masses side by side"), Qt::Key_F, [this](bool on) {
    viewOptions.sideBySide = on ? scene::ViewOptions::SideBySide::Always : scene::ViewOptions::SideBySide::Never;
    const scene::Camera kept = view->camera();
    rebuildScene();
    view->setCamera(kept);
    view->fit();
  });
  aside->setCheckable(true);
  aside->setObjectName(QStringLiteral("sideBySide"));
  aside->setChecked(session.experiment().object.kind == experiment::ObjectKind::Parallel);
  QAction* wire = add(show, QStringLiteral("Surfaces as &wire frame"), Qt::Key_W,
                      [this](bool on) { view->setSurfaceStyle(on ? scene::SurfaceStyle::Wire : scene::SurfaceStyle::Glass); });
  wire->setCheckable(true);
  show->addSeparator();
  add(show, QStringLiteral("&Subject's screen"), Qt::Key_F11, [this] { window.toggleSubjectWindow(); });
  QAction* quiet = add(show, QStringLiteral("Without s&ound"), {}, [this](bool on) { sound.setMuted(on); });
  quiet->setCheckable(true);
  show->addSeparator();
  for (QDockWidget* d : window.findChildren<QDockWidget*>()) show->addAction(d->toggleViewAction());

  QMenu* help = window.menuBar()->addMenu(QStringLiteral("&Help"));
  add(help, QStringLiteral("&Keys and mouse"), Qt::Key_F1, [this] {
    auto* box = new QMessageBox(
        QMessageBox::NoIcon, QStringLiteral("Keys and mouse"),
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
    auto* box = new QMessageBox(
        QMessageBox::NoIcon, QStringLiteral("Reachlab"),
        QStringLiteral("<b>Reachlab %1</b><br>A laboratory for rest-to-rest reaching movements.<br>BSD-3-Clause.<br><br>Drawn by %2")
            .arg(QStringLiteral(REACHLAB_VERSION), view->rendererName().toHtmlEscaped()),
        QMessageBox::Close, &window);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->show();
  });
}

void MainWindow::Impl::wire() {
  MainWindow* w = &window;
  QObject::connect(object, &docks::ObjectDock::edited, w, [this](const experiment::Object& o) {
    experiment::Experiment e = session.experiment();
    e.object = o;
    if (o.kind == experiment::ObjectKind::Parallel) e.coupling.reset();
    else if (!e.coupling) e.coupling = experiment::Coupling{600, 0};
    edit(e, QStringLiteral("object"), [this](const QStringList& f) { object->setFaults(f); });
  });
  QObject::connect(coupling, &docks::CouplingDock::edited, w, [this](const experiment::Coupling& c) {
    experiment::Experiment e = session.experiment();
    e.coupling = c;
    edit(e, QStringLiteral("coupling"), [this](const QStringList& f) { coupling->setFaults(f); });
  });
  QObject::connect(task, &docks::TaskDock::edited, w, [this](const experiment::Task& t) {
    experiment::Experiment e = session.experiment();
    e.task = t;
    edit(e, QStringLiteral("task"), [this](const QStringList& f) { task->setFaults(f); });
  });
  QObject::connect(constraint, &docks::ConstraintDock::shapeMoved, w, [this](const std::map<std::string, double>& shape) {
    experiment::Experiment e = session.experiment();
    e.constraint.shape = shape;
    edit(e, QStringLiteral("shape"), [this](const QStringList& f) { constraint->setFaults(f); });
  });
  QObject::connect(constraint, &docks::ConstraintDock::chooseRequested, w, &MainWindow::chooseConstraint);
  QObject::connect(dock, &docks::SessionDock::nextRequested, w, [this] { next(); });
  QObject::connect(dock, &docks::SessionDock::abortRequested, w, [this] { session.abort(); });
  QObject::connect(dock, &docks::SessionDock::repeatRequested, w, [this] {
    if (session.repeat()) showStage(), showOverlay();
  });
  QObject::connect(dock, &docks::SessionDock::endRequested, w, [this] { session.endRun(); });
  QObject::connect(dock, &docks::SessionDock::noteWritten, w, [this](const QString& text) { session.note(text); });
  QObject::connect(dock, &docks::SessionDock::deviceChanged, w, [this] { showOverlay(); });
  QObject::connect(predictions, &docks::PredictionDock::chosenChanged, w, [this] { drawPredictions(); });
  QObject::connect(view, &scene::SceneView::handDragged, w, [this](double x, double y, double z) { session.pointTo(x, y, z); });
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
  QObject::connect(&session, &SessionController::told, w, [this](const QString& sentence) { say(sentence); });
  QObject::connect(&session, &SessionController::failed, w, [this](const QString& sentence) { say(sentence); });
  timer = new QTimer(w);
  timer->setTimerType(Qt::PreciseTimer);
  QObject::connect(timer, &QTimer::timeout, w, [this] { oneFrame(); });
  timer->start(16);  // until it is known who draws
}

}  // namespace reachlab::gui::app
