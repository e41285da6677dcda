#pragma once

class QMenu;

namespace reachlab::gui::app {

class MainWindow;

/// Entries of the View menu for the look of the scene. A look that belongs to the experiment is changed as an edit of the experiment.
void addLookMenu(MainWindow& window, QMenu& menu);

}  // namespace reachlab::gui::app
