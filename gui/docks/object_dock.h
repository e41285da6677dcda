#pragma once
#include <QDockWidget>
#include <array>

#include "sim/experiment/experiment.h"

class QComboBox;

namespace reachlab::gui::widgets {
class FaultLabel;
class NumberListEdit;
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// Edits the object: kind, masses, springs, dampers, viscosity, gravity. Knows widgets and Object, not the simulator.
class ObjectDock : public QDockWidget {
  Q_OBJECT
 public:
  explicit ObjectDock(QWidget* parent = nullptr);
  void setObject(const experiment::Object& object);  // displays; emits nothing
  void setFaults(const QStringList& faults);

 Q_SIGNALS:
  void edited(const reachlab::experiment::Object& object);  // the user changed something; may be faulty

 private:
  void tell();
  void setRules();  // of the lists, for the kind and as many masses as there are

  experiment::Object object_, accepted_;  // as entered, which may be refused; as it holds
  QComboBox* kind_;
  widgets::NumberListEdit *masses_, *stiffness_, *damping_;
  widgets::UnitSpinBox* viscosity_;
  std::array<widgets::UnitSpinBox*, 3> gravity_{};
  widgets::FaultLabel* faults_;
};

}  // namespace reachlab::gui::docks
