#pragma once

namespace reachlab::gui::app {

class MainWindow;

/// The menus of the window with their keys: each entry is one of the window's slots.
void addMenus(MainWindow& window);

}  // namespace reachlab::gui::app
