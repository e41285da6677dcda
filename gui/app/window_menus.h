#pragma once

class QAction;

namespace reachlab::gui::app {

class MainWindow;

/// Actions that begin and end trials, with their keys. They also work in the subject's window.
struct TrialActions {
  QAction *next = nullptr, *abort = nullptr, *repeat = nullptr, *end = nullptr, *nextSubject = nullptr, *subjectsScreen = nullptr;
};

/// The menus of the window with their keys: each entry is one of the window's slots.
TrialActions addMenus(MainWindow& window);

}  // namespace reachlab::gui::app
