#pragma once

class QMenu;

namespace reachlab::gui::app {

class MainWindow;

/// What the subject sees, hears and reads: on which screen, in which language, what is shown (stored in the experiment), how loud.
void addSubjectMenu(MainWindow& window, QMenu& menu);

}  // namespace reachlab::gui::app
