#pragma once

class QAction;

namespace reachlab::gui::app {

class MainWindow;

/// What begins and ends trials, with its keys: valid in the subject's window too.
struct TrialActions {
  QAction *next = nullptr, *abort = nullptr, *repeat = nullptr, *end = nullptr, *subjectsScreen = nullptr;
};

/// The menus of the window with their keys: each entry is one of the window's slots.
TrialActions addMenus(MainWindow& window);

}  // namespace reachlab::gui::app
