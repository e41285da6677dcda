#include "gui/docks/task_dock.h"

#include <QFormLayout>
#include <QLabel>

#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/number_list_edit.h"
#include "gui/widgets/unit_spin_box.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {

TaskDock::TaskDock(QWidget* parent) : Dock(QStringLiteral("Task"), QStringLiteral("taskDock"), parent) {
  auto* body = new QWidget;
  auto* form = new QFormLayout(body);
  start_ = new widgets::NumberListEdit;
  target_ = new widgets::NumberListEdit;
  duration_ = new widgets::UnitSpinBox(0.05, 60, QStringLiteral("s"));
  duration_->setObjectName(QStringLiteral("taskDuration"));
  time_ = new widgets::UnitSpinBox(0.001, 30, QStringLiteral("s"));
  position_ = new widgets::UnitSpinBox(1e-5, 1, QStringLiteral("m"));
  velocity_ = new widgets::UnitSpinBox(1e-5, 10, QStringLiteral("m/s"));
  start_->setObjectName(QStringLiteral("taskStart"));
  via_ = new widgets::NumberListEdit;
  via_->setObjectName(QStringLiteral("taskVia"));
  via_->setToolTip(QStringLiteral("Places that the last mass, or a bare hand, passes in this order before it arrives: x y z of each."));
  widgets::NumberListRule places;
  places.list = QStringLiteral("via");
  places.multipleOf = 3;
  places.most = 60;
  via_->setRule(places);
  viaRadius_ = new widgets::UnitSpinBox(1e-5, 1, QStringLiteral("m"));
  viaRadius_->setToolTip(QStringLiteral("Distance within which such a place counts as passed."));
  startLabel_ = new QLabel;
  targetLabel_ = new QLabel;
  form->addRow(startLabel_, start_);
  form->addRow(targetLabel_, target_);
  form->addRow(QStringLiteral("via x y z [m]"), via_);
  form->addRow(QStringLiteral("± via"), viaRadius_);
  form->addRow(QStringLiteral("time T"), duration_);
  form->addRow(QStringLiteral("± ΔT"), time_);
  form->addRow(QStringLiteral("± Δx"), position_);
  form->addRow(QStringLiteral("± Δv"), velocity_);
  faults()->setObjectName(QStringLiteral("taskFaults"));
  form->addRow(faults());
  duration_->setName(QStringLiteral("time T"));
  time_->setName(QStringLiteral("ΔT"));
  position_->setName(QStringLiteral("Δx"));
  velocity_->setName(QStringLiteral("Δv"));
  viaRadius_->setName(QStringLiteral("radius of via"));
  for (auto* list : {start_, target_, via_}) faults()->watch(list);
  for (auto* number : {duration_, time_, position_, velocity_, viaRadius_}) faults()->watch(number);
  setBody(body);

  const auto bind = [this](widgets::UnitSpinBox* box, auto set) {
    connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this, set](double v) {
      set(task_, v);
      tell();
    });
  };
  bind(duration_, [](experiment::Task& t, double v) { t.duration = v; });
  bind(time_, [](experiment::Task& t, double v) { t.tolerance.time = v; });
  bind(position_, [](experiment::Task& t, double v) { t.tolerance.position = v; });
  bind(velocity_, [](experiment::Task& t, double v) { t.tolerance.velocity = v; });
  bind(viaRadius_, [](experiment::Task& t, double v) { t.viaRadius = v; });
  connect(via_, &widgets::NumberListEdit::numbersEdited, this, [this] {
    const std::vector<double> numbers = *via_->numbers();
    task_.via.clear();
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) task_.via.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    tell();
  });
  connect(start_, &widgets::NumberListEdit::numbersEdited, this, [this] {
    task_.start = *start_->numbers();
    tell();
  });
  connect(target_, &widgets::NumberListEdit::numbersEdited, this, [this] {
    task_.target = *target_->numbers();
    tell();
  });
}

void TaskDock::display(const experiment::CompiledExperiment& experiment, bool editable) {
  body()->setEnabled(editable);
  if (!experiment.experiment().task) return;
  const experiment::Task& task = task_ = *experiment.experiment().task;
  const constraints::ConstraintKind kind = experiment.constraint().kind;  // what the numbers of start and target are
  widgets::NumberListRule rule;
  QString unit;
  if (kind == constraints::ConstraintKind::Free) {
    rule.names = QStringList{QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")};
    unit = QStringLiteral("x y z [m]");
  } else {
    for (const std::string& name : constraints::variablesOf(kind)) rule.names << QString::fromStdString(name);
    unit = rule.names.join(QLatin1Char(' ')) + QStringLiteral(" [1]");  // a formula's own measure, rad where it is an angle
  }
  rule.fewest = rule.most = static_cast<std::size_t>(rule.names.size());
  rule.list = QStringLiteral("start");
  start_->setRule(rule);
  startLabel_->setText(QStringLiteral("start ") + unit);
  rule.list = QStringLiteral("target");
  target_->setRule(rule);
  targetLabel_->setText(QStringLiteral("target ") + unit);
  const QString places = kind == constraints::ConstraintKind::Free
                             ? QStringLiteral("three coordinates in metres")
                             : QStringLiteral("the position on the constraint, by its parameters (rad for an angle): ") + unit;
  start_->setToolTip(places);
  target_->setToolTip(places);
  start_->setNumbers(task.start);
  target_->setNumbers(task.target);
  std::vector<double> via;
  for (const Vec3& place : task.via) via.insert(via.end(), {place.x, place.y, place.z});
  via_->setNumbers(via);
  viaRadius_->show(task.viaRadius);
  viaRadius_->setEnabled(!via.empty());
  duration_->show(task.duration);
  time_->show(task.tolerance.time);
  position_->show(task.tolerance.position);
  velocity_->show(task.tolerance.velocity);
}

void TaskDock::tell() {
  experiment::Experiment changed = shown();
  changed.task = task_;
  Q_EMIT edited(changed, QStringLiteral("task"));
}

}  // namespace reachlab::gui::docks
