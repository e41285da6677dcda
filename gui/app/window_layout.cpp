#include "gui/app/window_layout.h"

#include <QDockWidget>
#include <QGuiApplication>
#include <QMainWindow>
#include <QScreen>
#include <QSettings>
#include <algorithm>

namespace reachlab::gui::app {
namespace {

// Pixels, as the scale has them: docks left and right of a scene that is still seen, and three of them below one another.
constexpr int kThreeColumns = 1200, kThreeRows = 680;
constexpr QSize kWanted(1560, 960), kFrame(20, 50);  // of the window, and of the title bar and borders around it
constexpr int kLayoutVersion = 7;                    // another set of docks is another layout

QString key(const char* name) { return QLatin1String("window/") + QLatin1String(name); }

// In the order of WindowLayout: where the docks are remembered, and those that are shown at first. Empty: every dock.
struct Docks {
  QString key;
  QStringList shown;
};
Docks docksOf(WindowLayout layout) {
  const Docks docks[] = {{key("docksSetUp"), {}},
                         {key("docksRun"), {"sessionDock", "plotDock", "trialsDock", "stationsDock"}},
                         {key("docksInspect"), {"none"}}};
  return docks[static_cast<int>(layout)];
}

}  // namespace

void stackOnNarrowScreen(QMainWindow& window) {
  const QScreen* screen = QGuiApplication::primaryScreen();
  if (screen == nullptr) return;
  const bool narrow = screen->availableSize().width() < kThreeColumns, low = screen->availableSize().height() < kThreeRows;
  auto* onto = window.findChild<QDockWidget*>(low ? "sessionDock" : "trialsDock");
  if (onto == nullptr) return;
  for (QDockWidget* dock : window.findChildren<QDockWidget*>())
    if ((narrow && window.dockWidgetArea(dock) == Qt::RightDockWidgetArea) ||
        (low && dock->objectName() == QLatin1String("constraintDock")))
      window.tabifyDockWidget(onto, dock);
  if (low) onto->raise();
}

void rememberDocks(const QMainWindow& window, WindowLayout layout) {
  QSettings().setValue(docksOf(layout).key, window.saveState(kLayoutVersion));
}

void restoreDocks(QMainWindow& window, WindowLayout layout) {
  if (window.restoreState(QSettings().value(docksOf(layout).key).toByteArray(), kLayoutVersion)) return;
  const QStringList shown = docksOf(layout).shown;
  for (QDockWidget* dock : window.findChildren<QDockWidget*>()) dock->setVisible(shown.isEmpty() || shown.contains(dock->objectName()));
}

void rememberLayout(const QMainWindow& window, WindowLayout layout) {
  QSettings settings;
  settings.setValue(key("geometry"), window.saveGeometry());
  settings.setValue(key("layout"), static_cast<int>(layout));
  rememberDocks(window, layout);
}

WindowLayout restoreLayout(QMainWindow& window) {
  const QSettings settings;
  const auto layout = static_cast<WindowLayout>(std::clamp(settings.value(key("layout")).toInt(), 0, 2));
  const bool known = window.restoreGeometry(settings.value(key("geometry")).toByteArray());
  restoreDocks(window, layout);
  if (known) return layout;
  const QScreen* screen = QGuiApplication::primaryScreen();
  const QSize room = screen == nullptr ? kWanted : screen->availableSize();
  if (room.width() < (kWanted + kFrame).width() || room.height() < (kWanted + kFrame).height())
    window.setWindowState(window.windowState() | Qt::WindowMaximized);
  window.resize(kWanted.boundedTo(room - kFrame));
  return layout;
}

void forgetLayout() {
  QSettings settings;
  for (const char* name : {"geometry", "layout", "docksSetUp", "docksRun", "docksInspect"}) settings.remove(key(name));
}

}  // namespace reachlab::gui::app
