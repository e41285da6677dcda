#include "gui/app/window_menus.h"

#include <QDockWidget>
#include <QFileDialog>
#include <QMenuBar>
#include <QMessageBox>
#include <QUndoStack>

#include "gui/app/menu_entries.h"
#include "gui/scene/renderer_name.h"
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
  QStringList rows{keyRow(QStringLiteral("left drag"), QStringLiteral("moves the hand (device mouse)")),
                   keyRow(QStringLiteral("right drag"), QStringLiteral("turns the view")),
                   keyRow(QStringLiteral("middle drag"), QStringLiteral("shifts the view")),
                   keyRow(QStringLiteral("wheel"), QStringLiteral("zooms")),
                   keyRow(QStringLiteral("Tab"), QStringLiteral("goes to the next field or button"))};
  listKeys(window.menuBar()->actions(), rows);
  const int half = (rows.size() + 1) / 2;
  QString columns;
  for (const QStringList& column : {QStringList(rows.mid(0, half)), QStringList(rows.mid(half))})
    columns += QStringLiteral("<td><table cellpadding=2>%1</table></td>").arg(column.join(QString()));
  say(window, QStringLiteral("Keys and mouse"), QStringLiteral("<table><tr>%1</tr></table>").arg(columns));
}

void sayAbout(MainWindow& window) {
  say(window, QStringLiteral("Reachlab"),
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
  QMenu& menu = *window.menuBar()->addMenu(QStringLiteral("&Experiment"));
  QMenu* fresh = menu.addMenu(QStringLiteral("&New"));
  for (const Template& from : templates()) addEntry(window, *fresh, QLatin1String(from.title), [&window, from] { window.beginNew(from); });
  addEntry(window, menu, QStringLiteral("&Open…"), &MainWindow::openFile, QKeySequence::Open);
  const auto inspect = [&window] {
    const QString folder = QFileDialog::getExistingDirectory(&window, QStringLiteral("Inspect a dataset or a session"));
    if (!folder.isEmpty()) window.inspect(folder);
  };
  addEntry(window, menu, QStringLiteral("&Inspect a dataset…"), inspect, QStringLiteral("Ctrl+I"));
  const auto analyse = [&window] {
    const QString folder = QFileDialog::getExistingDirectory(&window, QStringLiteral("Analyse a dataset"));
    if (!folder.isEmpty()) window.analyse(folder);
  };
  addEntry(window, menu, QStringLiteral("&Analyse a dataset…"), analyse)->setObjectName(QStringLiteral("analyse"));
  QMenu* recent = menu.addMenu(QStringLiteral("Open &recent"));
  recent->setObjectName(QStringLiteral("recent"));
  QObject::connect(&menu, &QMenu::aboutToShow, recent, [&window, recent] { listRecent(window, *recent); });
  QMenu* shipped = menu.addMenu(QStringLiteral("S&hipped"));
  for (const std::string& shippedName : experiment::shippedExperiments()) {
    const QString name = QString::fromStdString(shippedName);
    addEntry(window, *shipped, name, [&window, name] { window.openExperiment(name); });
  }
  addEntry(window, menu, QStringLiteral("Session &plan…"), &MainWindow::composePlan, QStringLiteral("Ctrl+P"));
  addEntry(window, menu, QStringLiteral("&Save"), &MainWindow::saveExperiment, QKeySequence::Save);
  addEntry(window, menu, QStringLiteral("Save &as…"), &MainWindow::saveExperimentAs, QKeySequence::SaveAs);
  menu.addSeparator();
  addEntry(window, menu, QStringLiteral("&Quit"), &QWidget::close, QKeySequence::Quit);
}

void addEditMenu(MainWindow& window) {
  QMenu& menu = *window.menuBar()->addMenu(QStringLiteral("E&dit"));
  QAction* undo = window.edits().createUndoAction(&window, QStringLiteral("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = window.edits().createRedoAction(&window, QStringLiteral("&Redo"));
  redo->setShortcut(QKeySequence::Redo);
  menu.addActions({undo, redo});
  menu.addSeparator();
  addEntry(window, menu, QStringLiteral("Choose or type a &constraint…"), &MainWindow::chooseConstraint, QStringLiteral("Ctrl+K"));
}

void addTrialMenu(MainWindow& window, TrialActions& actions) {
  QMenu& menu = *window.menuBar()->addMenu(QStringLiteral("&Trial"));
  actions.next = addEntry(window, menu, QStringLiteral("&Start"), &MainWindow::nextTrial, Qt::Key_Space);
  actions.next->setToolTip(QStringLiteral("Starts the run, then the next trial. Space works in the scene and on this button."));
  // Space in a list or on a box is theirs: it begins a recording only in the scene, to which the window adds this action.
  actions.next->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  actions.abort = addEntry(window, menu, QStringLiteral("&Abort"), &MainWindow::abortTrial, Qt::Key_Escape);
  actions.abort->setToolTip(QStringLiteral("Aborts the trial. It does not count."));
  // Not a letter alone: one that went astray would repeat a trial.
  actions.repeat = addEntry(window, menu, QStringLiteral("&Repeat"), &MainWindow::repeatTrial, QStringLiteral("Ctrl+R"));
  actions.repeat->setToolTip(QStringLiteral("Repeats the last trial at the end of the run."));
  addEntry(window, menu, QStringLiteral("Res&ume the session"), &MainWindow::resumeSession)->setObjectName(QStringLiteral("resume"));
  actions.end = addEntry(window, menu, QStringLiteral("&End run"), &MainWindow::endRun, QStringLiteral("Ctrl+E"));
  actions.end->setToolTip(QStringLiteral("Ends the run: closes the log and writes the dataset."));
  actions.nextSubject = addEntry(window, menu, QStringLiteral("Next su&bject"), &MainWindow::nextSubject);
  actions.nextSubject->setObjectName(QStringLiteral("nextSubject"));
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
  addEntry(window, menu, QStringLiteral("In their &places"), &MainWindow::resetLayout)->setObjectName(QStringLiteral("resetLayout"));
}

void addViewMenu(MainWindow& window, TrialActions& actions) {
  QMenu& menu = *window.menuBar()->addMenu(QStringLiteral("&View"));
  scene::SceneView& view = window.view();
  Screens& screens = window.screens();
  addEntry(
      window, menu, QStringLiteral("&Whole scene"), [&view] { view.resetCamera(); }, Qt::Key_Home);
  int number = 1;
  for (const char axis : {'x', 'y', 'z'})
    addEntry(
        window, menu, QStringLiteral("Along %1").arg(axis), [&view, axis] { view.lookAlong(axis); },
        QStringLiteral("Ctrl+%1").arg(number++));
  menu.addSeparator();
  QAction* aside = addSwitch(
      window, menu, QStringLiteral("&Masses side by side"), [&screens](bool on) { screens.setSideBySide(on); }, Qt::Key_F);
  aside->setObjectName(QStringLiteral("sideBySide"));
  aside->setChecked(window.session().experiment().object.kind == experiment::ObjectKind::Parallel);
  const auto style = [&view](bool on) { view.setSurfaceStyle(on ? scene::SurfaceStyle::Wire : scene::SurfaceStyle::Glass); };
  addSwitch(window, menu, QStringLiteral("Surfaces as &wire frame"), style, Qt::Key_W);
  QAction* forces = addSwitch(window, menu, QStringLiteral("&Forces on the hand"), [&screens](bool on) { screens.setForcesShown(on); });
  forces->setObjectName(QStringLiteral("forcesShown"));
  forces->setChecked(true);
  addLookMenu(window, menu);
  menu.addSeparator();
  actions.subjectsScreen = addEntry(
      window, menu, QStringLiteral("&Subject's screen"), [&screens] { screens.toggleSubject(); }, Qt::Key_F11);
  addEntry(window, menu, QStringLiteral("Save pi&cture…"), &MainWindow::savePicture, QStringLiteral("Ctrl+Shift+P"));
  menu.addSeparator();
  addSubjectMenu(window, menu);
  addSwitch(window, menu, QStringLiteral("Without s&ound"), [&window](bool on) { window.sounds().setMuted(on); });
  menu.addSeparator();
  addDocksMenu(window, *menu.addMenu(QStringLiteral("&Docks")));  // ten of them would make the menu longer than a small screen
}

void addHelpMenu(MainWindow& window) {
  QMenu& menu = *window.menuBar()->addMenu(QStringLiteral("&Help"));
  addEntry(window, menu, QStringLiteral("&Manual"), &MainWindow::openManual);
  addEntry(
      window, menu, QStringLiteral("&Keys and mouse"), [&window] { sayKeys(window); }, Qt::Key_F1);
  addEntry(window, menu, QStringLiteral("&About"), [&window] { sayAbout(window); });
}

}  // namespace

TrialActions addMenus(MainWindow& window) {
  TrialActions actions;
  addExperimentMenu(window);
  addEditMenu(window);
  addTrialMenu(window, actions);
  addViewMenu(window, actions);
  addHelpMenu(window);
  return actions;
}

}  // namespace reachlab::gui::app
