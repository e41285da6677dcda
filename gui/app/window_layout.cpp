#include "gui/app/window_layout.h"

#include <QGuiApplication>
#include <QMainWindow>
#include <QScreen>
#include <QSettings>

namespace reachlab::gui::app {
namespace {

constexpr int kLayoutVersion = 2;  // another set of docks is another layout

QString key(const char* name) { return QStringLiteral("window/") + QLatin1String(name); }

}  // namespace

void rememberLayout(const QMainWindow& window) {
  QSettings settings;
  settings.setValue(key("geometry"), window.saveGeometry());
  settings.setValue(key("docks"), window.saveState(kLayoutVersion));
}

void restoreLayout(QMainWindow& window) {
  const QSettings settings;
  const bool known = window.restoreGeometry(settings.value(key("geometry")).toByteArray());
  (void)window.restoreState(settings.value(key("docks")).toByteArray(), kLayoutVersion);
  if (known) return;
  const QScreen* screen = QGuiApplication::primaryScreen();
  const QSize room = screen == nullptr ? QSize(1560, 960) : screen->availableSize();
  const QSize wanted(1560, 960);
  // A title bar and borders come on top of this.
  if (room.width() < wanted.width() + 20 || room.height() < wanted.height() + 50)
    window.setWindowState(window.windowState() | Qt::WindowMaximized);
  window.resize(wanted.boundedTo(room - QSize(20, 50)));
}

void forgetLayout() { QSettings().remove(QStringLiteral("window")); }

}  // namespace reachlab::gui::app
