#include "gui/app/window_menus.h"

#include <QDockWidget>
#include <QFileDialog>
#include <QMenuBar>
#include <QMessageBox>
#include <QUndoStack>

#include "gui/app/menu_entries.h"
#include "gui/scene/software_canvas.h"
#include "gui/session/session_controller.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"

namespace reachlab::gui::app {
namespace {

void say(MainWindow& window, const QString& title, const QString& text) {
  auto* box = new QMessageBox(QMessageBox::NoIcon, title, text, QMessageBox::Close, &window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->show();
}

QString keyRow(const QString& keys, const QString& words) {
  return QStringLiteral("<tr><td><b>%1</b></td><td>%2</td></tr>").arg(keys.toHtmlEscaped(), words.toHtmlEscaped());
}

// A row for each action with keys, menu by menu.
void listKeys(const QList<QAction*>& actions, QStringList& rows) {
  for (const QAction* action : actions) {
    if (action->menu() != nullptr) listKeys(action->menu()->actions(), rows);
    if (!action->shortcut().isEmpty()) rows << keyRow(action->shortcut().toString(QKeySequence::NativeText), action->iconText());
  }
}

void sayKeys(MainWindow& window) {
  QStringList rows{keyRow("left drag", "moves the hand (device mouse)"),
                   keyRow("left drag on start or target", "moves it while no run is open"),
                   keyRow("right drag", "turns the view"),
                   keyRow("middle drag, Shift + left drag", "shifts the view"),
                   keyRow("wheel", "zooms"),
                   keyRow("Tab", "goes to the next field or button")};
  listKeys(window.menuBar()->actions(), rows);
  for (const auto& key : inspector::InspectorPage::keys()) rows << keyRow(key.keys, "Inspect: " + key.words);
  const int half = (rows.size() + 1) / 2;
  QString columns;
  for (const QStringList& column : {QStringList(rows.mid(0, half)), QStringList(rows.mid(half))})
    columns += QStringLiteral("<td><table cellpadding=2>%1</table></td>").arg(column.join(QString()));
  say(window, "Keys and mouse", QStringLiteral("<table style=\"white-space: nowrap\"><tr>%1</tr></table>").arg(columns));
}

void sayAbout(MainWindow& window) {
  say(window, "Reachlab",
      QStringLiteral("<b>Reachlab %1</b><br>A laboratory for rest-to-rest reaching movements.<br>BSD-3-Clause.<br><br>"
                     "Qt %2, VTK %3, Qwt %4<br>Drawn by %5")
          .arg(QStringLiteral(REACHLAB_VERSION), QLatin1String(qVersion()), scene::libraryVersion(), plot::libraryVersion(),
               scene::rendererName().toHtmlEscaped()));
}

void listRecent(MainWindow& window, QMenu& menu) {
  menu.clear();
  for (const QString& file : recentFiles()) addEntry(window, menu, file, [&window, file] { window.openExperiment(file); });
  menu.setEnabled(!menu.isEmpty());
}

void addExperimentMenu(MainWindow& window) {
  QMenu& menu = *window.menuBar()->addMenu("&Experiment");
  QMenu* fresh = menu.addMenu("&New");
  for (const Template& from : kTemplates) addEntry(window, *fresh, QLatin1String(from.title), [&window, from] { window.beginNew(from); });
  addEntry(window, menu, "&Open…", &MainWindow::openFile, QKeySequence::Open);
  const auto inspect = [&window] {
    const QString folder = QFileDialog::getExistingDirectory(&window, "Inspect a dataset or a session");
    if (!folder.isEmpty()) window.inspect(folder);
  };
  addEntry(window, menu, "&Inspect a dataset…", inspect, QKeySequence("Ctrl+I"));
  const auto analyse = [&window] {
    const QString folder = QFileDialog::getExistingDirectory(&window, "Analyse a dataset");
    if (!folder.isEmpty()) window.inspector().report(folder);
  };
  addEntry(window, menu, "Anal&yse a dataset…", analyse)->setObjectName("analyse");
  QMenu* recent = menu.addMenu("Open &recent");
  recent->setObjectName("recent");
  QObject::connect(&menu, &QMenu::aboutToShow, recent, [&window, recent] { listRecent(window, *recent); });
  QMenu* shipped = menu.addMenu("S&hipped");
  for (const std::string& shippedName : experiment::shippedExperiments()) {
    const QString name = QString::fromStdString(shippedName);
    addEntry(window, *shipped, name, [&window, name] { window.openExperiment(name); });
  }
  addEntry(window, menu, "Session &plan…", &MainWindow::composePlan, QKeySequence("Ctrl+P"));
  addEntry(window, menu, "&Save", &MainWindow::saveExperiment, QKeySequence::Save);
  addEntry(window, menu, "Save &as…", &MainWindow::saveExperimentAs, QKeySequence::SaveAs);
  menu.addSeparator();
  addEntry(window, menu, "&Quit", &QWidget::close, QKeySequence::Quit);
}

void addEditMenu(MainWindow& window, WindowActions& actions) {
  QMenu& menu = *window.menuBar()->addMenu("E&dit");
  actions.undo = window.edits().createUndoAction(&window, "&Undo");
  actions.undo->setShortcut(QKeySequence::Undo);
  actions.undo->setObjectName("undo");
  actions.redo = window.edits().createRedoAction(&window, "&Redo");
  actions.redo->setShortcut(QKeySequence::Redo);
  for (const auto& [action, does] : {std::pair{actions.undo, &MainWindow::undo}, std::pair{actions.redo, &MainWindow::redo}}) {
    action->disconnect(&window.edits());  // the stack would not ask
    QObject::connect(action, &QAction::triggered, &window, does);
  }
  menu.addActions({actions.undo, actions.redo});
  menu.addSeparator();
  addEntry(window, menu, "Choose or type a &constraint…", &MainWindow::chooseConstraint, QKeySequence("Ctrl+K"));
}

void addTrialMenu(MainWindow& window, WindowActions& actions) {
  QMenu& menu = *window.menuBar()->addMenu("&Trial");
  actions.next = addEntry(window, menu, "&Start", &MainWindow::nextTrial, Qt::Key_Space);
  actions.next->setToolTip("Starts the run, then the next trial. Space works in the scene and on this button.");
  // Space in a list or on a box is theirs: it begins a recording only in the scene, to which the window adds this action.
  actions.next->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  actions.abort = addEntry(window, menu, "&Abort", &MainWindow::abortTrial, Qt::Key_Escape);
  actions.abort->setToolTip("Aborts the trial. It does not count.");
  // Not a letter alone: one that went astray would repeat a trial.
  actions.repeat = addEntry(window, menu, "&Repeat", &MainWindow::repeatTrial, QKeySequence("Ctrl+R"));
  actions.repeat->setToolTip("Repeats the last trial at the end of the run.");
  addEntry(window, menu, "Res&ume the session", &MainWindow::resumeSession)->setObjectName("resume");
  actions.end = addEntry(window, menu, "&End run", &MainWindow::endRun, QKeySequence("Ctrl+E"));
  actions.end->setToolTip("Ends the run: closes the log and writes the dataset.");
  actions.nextSubject = addEntry(window, menu, "Next su&bject", &MainWindow::nextSubject);
  actions.nextSubject->setObjectName("nextSubject");
  for (QAction* action : {actions.next, actions.abort, actions.repeat, actions.end}) action->setAutoRepeat(false);
}

void addDocksMenu(MainWindow& window, QMenu& menu) {
  for (QDockWidget* dock : window.findChildren<QDockWidget*>()) menu.addAction(dock->toggleViewAction());
  menu.addSeparator();
  const std::pair<const char*, WindowLayout> layouts[] = {
      {"Layout: &set up", WindowLayout::SetUp}, {"Layout: &run", WindowLayout::Run}, {"Layout: &inspect", WindowLayout::Inspect}};
  int number = 1;
  for (const auto& [title, layout] : layouts)
    addEntry(
        window, menu, title, [&window, layout = layout] { window.switchLayout(layout); }, QStringLiteral("Alt+%1").arg(number++));
  addEntry(window, menu, "In their &places", &MainWindow::resetLayout)->setObjectName("resetLayout");
}

void addViewMenu(MainWindow& window, WindowActions& actions) {
  QMenu& menu = *window.menuBar()->addMenu("&View");
  scene::SceneView& view = window.view();
  Screens& screens = window.screens();
  addEntry(
      window, menu, "&Whole scene", [&view] { view.resetCamera(); }, Qt::Key_Home);
  int number = 1;
  for (const char axis : {'x', 'y', 'z'})
    addEntry(
        window, menu, QStringLiteral("Along &%1").arg(axis), [&view, axis] { view.lookAlong(axis); },
        QStringLiteral("Ctrl+%1").arg(number++));
  menu.addSeparator();
  QAction* aside = addSwitch(
      window, menu, "&Masses side by side", [&screens](bool on) { screens.setSideBySide(on); }, Qt::Key_F);
  aside->setObjectName("sideBySide");
  aside->setChecked(window.session().experiment().object.kind == experiment::ObjectKind::Parallel);
  const auto style = [&view](bool on) { view.setSurfaceStyle(on ? scene::SurfaceStyle::Wire : scene::SurfaceStyle::Glass); };
  addSwitch(window, menu, "Surfaces as w&ire frame", style, Qt::Key_W);
  QAction* forces = addSwitch(window, menu, "&Forces on the hand", [&screens](bool on) { screens.setForcesShown(on); });
  forces->setObjectName("forcesShown");
  forces->setChecked(true);
  addLookMenu(window, menu);
  menu.addSeparator();
  actions.subjectsScreen = addEntry(
      window, menu, "&Subject's screen", [&screens] { screens.toggleSubject(); }, Qt::Key_F11);
  addEntry(window, menu, "Save pi&cture…", &MainWindow::savePicture, QKeySequence("Ctrl+Shift+P"));
  menu.addSeparator();
  addSubjectMenu(window, menu);
  addSwitch(window, menu, "Without sou&nd", [&window](bool on) { window.sounds().setMuted(on); });
  menu.addSeparator();
  addDocksMenu(window, *menu.addMenu("&Docks"));  // ten of them would make the menu longer than a small screen
}

void addHelpMenu(MainWindow& window) {
  QMenu& menu = *window.menuBar()->addMenu("&Help");
  addEntry(window, menu, "&Manual", &MainWindow::openManual);
  addEntry(
      window, menu, "&Keys and mouse", [&window] { sayKeys(window); }, Qt::Key_F1);
  addEntry(window, menu, "&About", [&window] { sayAbout(window); });
}

}  // namespace

WindowActions addMenus(MainWindow& window) {
  WindowActions actions;
  addExperimentMenu(window);
  addEditMenu(window, actions);
  addTrialMenu(window, actions);
  addViewMenu(window, actions);
  addHelpMenu(window);
  return actions;
}

}  // namespace reachlab::gui::app
