#pragma once

class QMainWindow;

namespace reachlab::gui::app {

/// The purposes that the docks are arranged for. Each arrangement is remembered as the user left it.
enum class WindowLayout { SetUp, Run, Inspect };

/// Remembers position, layout and docks of the window from one start to the next (QSettings).
void rememberLayout(const QMainWindow& window, WindowLayout layout);
/// Restores the window as it was left. At the first start, it is as large as the screen allows.
WindowLayout restoreLayout(QMainWindow& window);
void forgetLayout();

/// Makes room on small screens. If docks on both sides or three docks in a column leave no room, some become tabs on the left. These are
/// the docks on the right and the constraint.
void stackOnNarrowScreen(QMainWindow& window);
void rememberDocks(const QMainWindow& window, WindowLayout layout);
/// Restores the docks as they were left in this layout, or as the layout begins. SetUp begins with every dock, Run with session and plot.
/// Inspect begins without docks, because a recording has a separate page.
void restoreDocks(QMainWindow& window, WindowLayout layout);

}  // namespace reachlab::gui::app
