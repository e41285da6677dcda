#pragma once
#include <array>

#include "gui/docks/dock.h"

class QComboBox;

namespace reachlab::gui::widgets {
class NumberListEdit;
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// Edits the object: kind, masses, springs, dampers, viscosity, gravity. Knows widgets and Object, not the simulator.
class ObjectDock : public Dock {
  Q_OBJECT
 public:
  explicit ObjectDock(QWidget* parent = nullptr);

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  void tell();
  void setRules();  // of the lists, for the kind and as many masses as there are

  experiment::Object object_;  // as entered, which may be refused
  QComboBox* kind_;
  widgets::NumberListEdit *masses_, *stiffness_, *damping_;
  widgets::UnitSpinBox* viscosity_;
  std::array<widgets::UnitSpinBox*, 3> gravity_{};
};

}  // namespace reachlab::gui::docks
