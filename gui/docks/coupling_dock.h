#pragma once
#include "gui/docks/dock.h"

namespace reachlab::gui::widgets {
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// Edits the coupling (8) between hand and driven mass. Knows widgets and Coupling, not the simulator.
class CouplingDock : public Dock {
  Q_OBJECT
 public:
  explicit CouplingDock(QWidget* parent = nullptr);

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  widgets::UnitSpinBox *stiffness_, *damping_;
};

}  // namespace reachlab::gui::docks
