#pragma once
#include "gui/docks/dock.h"

class QLabel;

namespace reachlab::gui::widgets {
class NumberListEdit;
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// Edits the task: where from, where to, how long, how exactly. Knows widgets and Task, not the simulator.
class TaskDock : public Dock {
  Q_OBJECT
 public:
  explicit TaskDock(QWidget* parent = nullptr);

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  void tell();

  experiment::Task task_;
  widgets::NumberListEdit *start_, *target_, *via_;
  widgets::UnitSpinBox *duration_, *time_, *position_, *velocity_, *viaRadius_;
  QLabel *startLabel_, *targetLabel_, *length_;
};

}  // namespace reachlab::gui::docks
