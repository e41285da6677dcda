#include "gui/task_dock.h"

#include <QFormLayout>

#include "gui/fault_label.h"
#include "gui/number_list_edit.h"
#include "gui/unit_spin_box.h"

namespace reachlab {

TaskDock::TaskDock(QWidget* parent) : QDockWidget(QStringLiteral("Task"), parent) {
  setObjectName(QStringLiteral("taskDock"));
  auto* body = new QWidget;
  auto* form = new QFormLayout(body);
  start_ = new NumberListEdit;
  target_ = new NumberListEdit;
  duration_ = new UnitSpinBox(0.05, 60, QStringLiteral("s"));
  duration_->setObjectName(QStringLiteral("taskDuration"));
  time_ = new UnitSpinBox(0.001, 30, QStringLiteral("s"));
  position_ = new UnitSpinBox(1e-5, 1, QStringLiteral("m"));
  velocity_ = new UnitSpinBox(1e-5, 10, QStringLiteral("m/s"));
  form->addRow(QStringLiteral("start"), start_);
  form->addRow(QStringLiteral("target"), target_);
  form->addRow(QStringLiteral("time T"), duration_);
  form->addRow(QStringLiteral("± ΔT"), time_);
  form->addRow(QStringLiteral("± Δx"), position_);
  form->addRow(QStringLiteral("± Δv"), velocity_);
  const QString places = QStringLiteral("parameters of the constraint: phi, or u and v; three metres when free");
  start_->setToolTip(places);
  target_->setToolTip(places);
  faults_ = new FaultLabel;
  form->addRow(faults_);
  setWidget(body);

  const auto bind = [this](UnitSpinBox* box, auto set) {
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, set](double v) {
      set(task_, v);
      Q_EMIT edited(task_);
    });
  };
  bind(duration_, [](Task& t, double v) { t.duration = v; });
  bind(time_, [](Task& t, double v) { t.tolerance.time = v; });
  bind(position_, [](Task& t, double v) { t.tolerance.position = v; });
  bind(velocity_, [](Task& t, double v) { t.tolerance.velocity = v; });
  connect(start_, &NumberListEdit::numbersEdited, this, [this] {
    task_.start = *start_->numbers();
    Q_EMIT edited(task_);
  });
  connect(target_, &NumberListEdit::numbersEdited, this, [this] {
    task_.target = *target_->numbers();
    Q_EMIT edited(task_);
  });
}

void TaskDock::setTask(const Task& task) {
  task_ = task;
  start_->setNumbers(task.start);
  target_->setNumbers(task.target);
  duration_->show(task.duration);
  time_->show(task.tolerance.time);
  position_->show(task.tolerance.position);
  velocity_->show(task.tolerance.velocity);
}

void TaskDock::setFaults(const QStringList& faults) { faults_->setFaults(faults); }

}  // namespace reachlab
