#include "gui/app/window_menus.h"

#include <QAction>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenuBar>
#include <QMessageBox>
#include <QUndoStack>

#include "gui/app/look_menu.h"
#include "gui/app/main_window.h"
#include "gui/app/subject_menu.h"
#include "gui/plot/velocity_plot.h"
#include "gui/scene/renderer_name.h"
#include "gui/scene/scene_view.h"
#include "gui/session/session_controller.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"

namespace reachlab::gui::app {
namespace {

template <typename Slot>
QAction* add(MainWindow& window, QMenu* menu, const QString& text, const QKeySequence& key, Slot slot) {
  QAction* action = menu->addAction(text);
  action->setShortcut(key);
  QObject::connect(action, &QAction::triggered, &window, slot);
  return action;
}

template <typename Slot>
QAction* addSwitch(MainWindow& window, QMenu* menu, const QString& text, const QKeySequence& key, Slot slot) {
  QAction* action = add(window, menu, text, key, slot);
  action->setCheckable(true);
  return action;
}

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
  for (const QString& file : recentFiles()) add(window, &menu, file, {}, [&window, file] { window.openExperiment(file); });
  menu.setEnabled(!menu.isEmpty());
}

void addExperimentMenu(MainWindow& window) {
  QMenu* menu = window.menuBar()->addMenu(QStringLiteral("&Experiment"));
  QMenu* fresh = menu->addMenu(QStringLiteral("&New"));
  for (const Template& from : templates()) add(window, fresh, QLatin1String(from.title), {}, [&window, from] { window.beginNew(from); });
  add(window, menu, QStringLiteral("&Open…"), QKeySequence::Open, &MainWindow::openFile);
  add(window, menu, QStringLiteral("&Inspect a dataset…"), QKeySequence(QStringLiteral("Ctrl+I")), [&window] {
    const QString folder = QFileDialog::getExistingDirectory(&window, QStringLiteral("Inspect a dataset or a session"));
    if (!folder.isEmpty()) window.inspect(folder);
  });
  add(window, menu, QStringLiteral("&Analyse a dataset…"), {}, [&window] {
    const QString folder = QFileDialog::getExistingDirectory(&window, QStringLiteral("Analyse a dataset"));
    if (!folder.isEmpty()) window.analyse(folder);
  })->setObjectName(QStringLiteral("analyse"));
  QMenu* recent = menu->addMenu(QStringLiteral("Open &recent"));
  recent->setObjectName(QStringLiteral("recent"));
  QObject::connect(menu, &QMenu::aboutToShow, recent, [&window, recent] { listRecent(window, *recent); });
  QMenu* shipped = menu->addMenu(QStringLiteral("S&hipped"));
  for (const std::string& name : experiment::shippedExperiments())
    add(window, shipped, QString::fromStdString(name), {}, [&window, name] { window.openExperiment(QString::fromStdString(name)); });
  add(window, menu, QStringLiteral("Session &plan…"), QKeySequence(QStringLiteral("Ctrl+P")), &MainWindow::composePlan);
  add(window, menu, QStringLiteral("&Save"), QKeySequence::Save, [&window] { window.saveExperiment(); });
  add(window, menu, QStringLiteral("Save &as…"), QKeySequence::SaveAs, [&window] { window.saveExperimentAs(); });
  menu->addSeparator();
  add(window, menu, QStringLiteral("&Quit"), QKeySequence::Quit, &QWidget::close);
}

void addEditMenu(MainWindow& window) {
  QMenu* menu = window.menuBar()->addMenu(QStringLiteral("E&dit"));
  QAction* undo = window.edits().createUndoAction(&window, QStringLiteral("&Undo"));
  undo->setShortcut(QKeySequence::Undo);
  QAction* redo = window.edits().createRedoAction(&window, QStringLiteral("&Redo"));
  redo->setShortcut(QKeySequence::Redo);
  menu->addActions({undo, redo});
  menu->addSeparator();
  add(window, menu, QStringLiteral("Choose or type a &constraint…"), QKeySequence(QStringLiteral("Ctrl+K")), &MainWindow::chooseConstraint);
}

void addTrialMenu(MainWindow& window, TrialActions& actions) {
  QMenu* menu = window.menuBar()->addMenu(QStringLiteral("&Trial"));
  actions.next = add(window, menu, QStringLiteral("&Start"), Qt::Key_Space, &MainWindow::nextTrial);
  actions.next->setToolTip(QStringLiteral("Starts the run, then the next trial. Space works in the scene and on this button."));
  // Space in a list or on a box is theirs: it begins a recording only in the scene, to which the window adds this action.
  actions.next->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  actions.abort = add(window, menu, QStringLiteral("&Abort"), Qt::Key_Escape, &MainWindow::abortTrial);
  actions.abort->setToolTip(QStringLiteral("Aborts the trial. It does not count."));
  // Not a letter alone: one that went astray would repeat a trial.
  actions.repeat = add(window, menu, QStringLiteral("&Repeat"), QKeySequence(QStringLiteral("Ctrl+R")), &MainWindow::repeatTrial);
  actions.repeat->setToolTip(QStringLiteral("Repeats the last trial at the end of the run."));
  add(window, menu, QStringLiteral("Res&ume the session"), {}, &MainWindow::resumeSession)->setObjectName(QStringLiteral("resume"));
  actions.end = add(window, menu, QStringLiteral("&End run"), QKeySequence(QStringLiteral("Ctrl+E")), &MainWindow::endRun);
  actions.end->setToolTip(QStringLiteral("Ends the run: closes the log and writes the dataset."));
  actions.nextSubject = add(window, menu, QStringLiteral("Next su&bject"), {}, &MainWindow::nextSubject);
  actions.nextSubject->setObjectName(QStringLiteral("nextSubject"));
  for (QAction* action : {actions.next, actions.abort, actions.repeat, actions.end}) action->setAutoRepeat(false);
}

void addViewMenu(MainWindow& window, TrialActions& actions) {
  QMenu* menu = window.menuBar()->addMenu(QStringLiteral("&View"));
  add(window, menu, QStringLiteral("&Whole scene"), Qt::Key_Home, [&window] { window.view().resetCamera(); });
  const char axes[] = {'x', 'y', 'z'};
  for (int i = 0; i < 3; ++i)
    add(window, menu, QStringLiteral("Along %1").arg(QLatin1Char(axes[i])), QKeySequence(QStringLiteral("Ctrl+%1").arg(i + 1)),
        [&window, axis = axes[i]] { window.view().lookAlong(axis); });
  menu->addSeparator();
  QAction* aside = addSwitch(window, menu, QStringLiteral("&Masses side by side"), Qt::Key_F, &MainWindow::setSideBySide);
  aside->setObjectName(QStringLiteral("sideBySide"));
  aside->setChecked(window.session().experiment().object.kind == experiment::ObjectKind::Parallel);
  addSwitch(window, menu, QStringLiteral("Surfaces as &wire frame"), Qt::Key_W,
            [&window](bool on) { window.view().setSurfaceStyle(on ? scene::SurfaceStyle::Wire : scene::SurfaceStyle::Glass); });
  QAction* forces = addSwitch(window, menu, QStringLiteral("&Forces on the hand"), {}, &MainWindow::setForcesShown);
  forces->setObjectName(QStringLiteral("forcesShown"));
  forces->setChecked(true);
  addLookMenu(window, *menu);
  menu->addSeparator();
  actions.subjectsScreen = add(window, menu, QStringLiteral("&Subject's screen"), Qt::Key_F11, &MainWindow::toggleSubjectWindow);
  add(window, menu, QStringLiteral("Save pi&cture…"), QKeySequence(QStringLiteral("Ctrl+Shift+P")), &MainWindow::savePicture);
  menu->addSeparator();
  addSubjectMenu(window, *menu);
  addSwitch(window, menu, QStringLiteral("Without s&ound"), {}, &MainWindow::setMuted);
  menu->addSeparator();
  menu = menu->addMenu(QStringLiteral("&Docks"));  // ten of them would make the menu longer than a small screen
  for (QDockWidget* dock : window.findChildren<QDockWidget*>()) menu->addAction(dock->toggleViewAction());
  menu->addSeparator();
  const std::pair<const char*, WindowLayout> layouts[] = {
      {"Layout: &set up", WindowLayout::SetUp}, {"Layout: &run", WindowLayout::Run}, {"Layout: &inspect", WindowLayout::Inspect}};
  int number = 1;
  for (const auto& [title, layout] : layouts)
    add(window, menu, QLatin1String(title), QKeySequence(QStringLiteral("Alt+%1").arg(number++)),
        [&window, layout = layout] { window.switchLayout(layout); });
  add(window, menu, QStringLiteral("In their &places"), {}, &MainWindow::resetLayout)->setObjectName(QStringLiteral("resetLayout"));
}

void addHelpMenu(MainWindow& window) {
  QMenu* menu = window.menuBar()->addMenu(QStringLiteral("&Help"));
  add(window, menu, QStringLiteral("&Manual"), {}, &MainWindow::openManual);
  add(window, menu, QStringLiteral("&Keys and mouse"), Qt::Key_F1, [&window] { sayKeys(window); });
  add(window, menu, QStringLiteral("&About"), {}, [&window] { sayAbout(window); });
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
