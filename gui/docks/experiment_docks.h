#pragma once
#include "gui/docks/dock.h"

namespace reachlab::gui::docks {

/// Docks that edit one part of the experiment each: the object, the coupling (8) between hand and driven mass, the task, and the forces on
/// the hand with the cursor beside it. They know widgets and the experiment, not the simulator.
Dock* makeObjectDock(QWidget* parent = nullptr);
Dock* makeCouplingDock(QWidget* parent = nullptr);
Dock* makeTaskDock(QWidget* parent = nullptr);
/// Its fields follow from the keys of an experiment's file (experiment_keys.h).
Dock* makeEnvironmentDock(QWidget* parent = nullptr);

}  // namespace reachlab::gui::docks
