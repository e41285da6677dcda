#pragma once
#include <QDockWidget>
#include <optional>

#include "sim/experiment/experiment.h"

namespace reachlab::gui::widgets {
class FaultLabel;
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// Edits the coupling (8) between hand and driven mass. Knows widgets and Coupling, not the simulator.
class CouplingDock : public QDockWidget {
  Q_OBJECT
 public:
  explicit CouplingDock(QWidget* parent = nullptr);
  /// nullopt: a parallel object, whose springs are the hand's own.
  void setCoupling(const std::optional<experiment::Coupling>& coupling);
  void setFaults(const QStringList& faults);

 Q_SIGNALS:
  void edited(const reachlab::experiment::Coupling& coupling);

 private:
  widgets::UnitSpinBox *stiffness_, *damping_;
  widgets::FaultLabel* faults_;
};

}  // namespace reachlab::gui::docks
