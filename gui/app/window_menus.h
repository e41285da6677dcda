#pragma once

class QAction;

namespace reachlab::gui::app {

class MainWindow;

/// Actions that are enabled by what the window shows. Those of trials also work in the subject's window.
struct WindowActions {
  QAction *next = nullptr, *abort = nullptr, *repeat = nullptr, *end = nullptr, *nextSubject = nullptr, *subjectsScreen = nullptr;
  QAction *undo = nullptr, *redo = nullptr;
};

/// The menus of the window with their keys: each entry is one of the window's slots.
WindowActions addMenus(MainWindow& window);

}  // namespace reachlab::gui::app
