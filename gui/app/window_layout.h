#pragma once

class QMainWindow;

namespace reachlab::gui::app {

/// What the docks are arranged for; each arrangement is remembered as it was left.
enum class WindowLayout { SetUp, Run, Inspect };

/// Where the window stands, which layout it has, and where its docks stand: remembered from one start to the next (QSettings).
void rememberLayout(const QMainWindow& window, WindowLayout layout);
/// As it was left; at the first start as large as the screen allows.
WindowLayout restoreLayout(QMainWindow& window);
void forgetLayout();

/// Where docks on both sides, or three below one another, would leave no room, those of the right and the constraint become tabs on the left.
void stackOnNarrowScreen(QMainWindow& window);
void rememberDocks(const QMainWindow& window, WindowLayout layout);
/// As they were left in this layout, or as it begins: everything to set up, the session and the plot to run, none to
/// inspect: a recording has its own page.
void restoreDocks(QMainWindow& window, WindowLayout layout);

}  // namespace reachlab::gui::app
