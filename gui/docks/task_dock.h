#pragma once
#include <QDockWidget>

#include "sim/experiment/experiment.h"

class QLabel;

namespace reachlab::gui::widgets {
class FaultLabel;
class NumberListEdit;
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// Edits the task: where from, where to, how long, how exactly. Knows widgets and Task, not the simulator.
class TaskDock : public QDockWidget {
  Q_OBJECT
 public:
  explicit TaskDock(QWidget* parent = nullptr);
  /// `kind`: what the numbers of start and target are.
  void setTask(const experiment::Task& task, constraints::ConstraintKind kind);
  void setFaults(const QStringList& faults);

 Q_SIGNALS:
  void edited(const reachlab::experiment::Task& task);

 private:
  experiment::Task task_;
  widgets::NumberListEdit *start_, *target_;
  widgets::UnitSpinBox *duration_, *time_, *position_, *velocity_;
  QLabel *startLabel_, *targetLabel_;
  widgets::FaultLabel* faults_;
};

}  // namespace reachlab::gui::docks
