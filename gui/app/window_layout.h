#pragma once

class QMainWindow;

namespace reachlab::gui::app {

/// Where the window and its docks stand, remembered from one start to the next (QSettings).
void rememberLayout(const QMainWindow& window);
/// As it was left, if it still fits a screen; else as large as the screen allows.
void restoreLayout(QMainWindow& window);
void forgetLayout();

}  // namespace reachlab::gui::app
