#pragma once
#include <QAction>
#include <QKeySequence>
#include <QMenu>
#include <functional>

#include "gui/app/main_window.h"

class QSlider;

namespace reachlab::gui::app {

/// Adds an entry that calls a slot of the window.
template <typename Slot>
QAction* addEntry(MainWindow& window, QMenu& menu, const QString& text, Slot slot, const QKeySequence& key = {}) {
  QAction* action = menu.addAction(text);
  action->setShortcut(key);
  QObject::connect(action, &QAction::triggered, &window, slot);
  return action;
}

/// Adds an entry with a check mark. The slot receives whether the entry is checked.
template <typename Slot>
QAction* addSwitch(MainWindow& window, QMenu& menu, const QString& text, Slot slot, const QKeySequence& key = {}) {
  QAction* action = addEntry(window, menu, text, slot, key);
  action->setCheckable(true);
  return action;
}

/// A switch of the experiment. It shows the present state whenever the menu opens. In a plan it is fixed, because the plan's experiments
/// are in their files.
QAction* addExperimentSwitch(MainWindow& window, QMenu& menu, const QString& text, const QString& name, const std::function<bool()>& isOn,
                             const std::function<void(bool)>& set);

/// A slider from 0 to 100 behind its title.
QSlider* addSlider(QMenu& menu, const QString& title, const char* name, int width);

/// Entries of the View menu for the look of the scene. A look that belongs to the experiment is changed as an edit of the experiment.
void addLookMenu(MainWindow& window, QMenu& menu);

/// Menus of the subject's screen: monitor, visible parts (stored in the experiment), language, and loudness.
void addSubjectMenu(MainWindow& window, QMenu& menu);

}  // namespace reachlab::gui::app
