#pragma once

class QMenu;

namespace reachlab::gui::app {

class MainWindow;

/// How the scene is drawn, as entries of the View menu: what belongs to the experiment is an edit of it.
void addLookMenu(MainWindow& window, QMenu& menu);

}  // namespace reachlab::gui::app
