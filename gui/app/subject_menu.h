#pragma once

class QMenu;

namespace reachlab::gui::app {

class MainWindow;

/// Menu of the subject's screen: monitor, language, visible parts (stored in the experiment), and loudness.
void addSubjectMenu(MainWindow& window, QMenu& menu);

}  // namespace reachlab::gui::app
