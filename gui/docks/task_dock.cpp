#include "gui/docks/task_dock.h"

#include <QFormLayout>
#include <QLabel>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/geometry/arc_length.h"
#include "constraints/geometry/task_path.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/named.h"
#include "gui/widgets/number_list_edit.h"
#include "gui/widgets/unit_spin_box.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {
namespace {

// A length in the field of one place is the length of the way from the other place: the reach keeps its direction, and -0.2 m turns it.
std::function<double(double)> lengthsFrom(const constraints::Constraint& constraint, const std::vector<double>& from,
                                          const std::vector<double>& towards) {
  if (constraint.kind == constraints::ConstraintKind::Free) return [](double metres) { return metres; };
  if (constraint.kind == constraints::ConstraintKind::Surface || from.size() != 1 || towards.size() != 1) return {};
  return [constraint, from = from[0], sense = towards[0] < from[0] ? -1.0 : 1.0](double metres) {
    return constraints::parameterAfter(constraint, from, sense * metres).value_or(std::numeric_limits<double>::quiet_NaN());
  };
}

// "0.3142 m along the curve". Empty on a surface, where there are many ways.
QString lengthOfReach(const constraints::Constraint& constraint, const experiment::Task& task) {
  const auto words = [](double metres, const QString& what) {
    return std::isfinite(metres) ? QStringLiteral("%1 m %2").arg(metres, 0, 'g', 4).arg(what) : QString();
  };
  if (constraint.kind == constraints::ConstraintKind::Surface) return {};
  if (constraint.kind == constraints::ConstraintKind::Free)
    return words(norm(placeOn(constraint, task.target) - placeOn(constraint, task.start)), QStringLiteral("from start to target"));
  try {
    return words(constraints::ArcLength(constraint, task.start.at(0), task.target.at(0)).length(), QStringLiteral("along the curve"));
  } catch (const Error&) {  // no value between them: said where the scene is compiled
    return {};
  }
}

}  // namespace

TaskDock::TaskDock(QWidget* parent) : Dock(QStringLiteral("Task"), QStringLiteral("taskDock"), parent) {
  auto* body = new QWidget;
  auto* form = new QFormLayout(body);
  start_ = new widgets::NumberListEdit;
  target_ = widgets::named<widgets::NumberListEdit>("taskTarget");
  duration_ = widgets::named<widgets::UnitSpinBox>("taskDuration", 0.05, 60, QStringLiteral("s"));
  time_ = new widgets::UnitSpinBox(0.001, 30, QStringLiteral("s"));
  position_ = new widgets::UnitSpinBox(1e-5, 1, QStringLiteral("m"));
  velocity_ = new widgets::UnitSpinBox(1e-5, 10, QStringLiteral("m/s"));
  start_->setObjectName(QStringLiteral("taskStart"));
  via_ = widgets::named<widgets::NumberListEdit>("taskVia");
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
  length_ = widgets::named<QLabel>("taskLength");
  length_->setProperty("role", "quiet");
  form->addRow(QString(), length_);
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
  duration_->setToolTip(QStringLiteral("duration of the movement that is asked for, from its onset"));
  time_->setToolTip(QStringLiteral("how much earlier or later than T the movement may end"));
  position_->setToolTip(QStringLiteral("how near the target every mass must be at the end"));
  velocity_->setToolTip(QStringLiteral("how slow every mass must be at the end"));
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
  const constraints::Constraint& constraint = experiment.constraint();
  rule.fewest = rule.most = static_cast<std::size_t>(rule.names.size());
  rule.formulas = kind != constraints::ConstraintKind::Free;
  rule.list = QStringLiteral("start");
  rule.atLength = lengthsFrom(constraint, task.target, task.start);
  start_->setRule(rule);
  startLabel_->setText(QStringLiteral("start ") + unit);
  rule.list = QStringLiteral("target");
  rule.atLength = lengthsFrom(constraint, task.start, task.target);
  target_->setRule(rule);
  targetLabel_->setText(QStringLiteral("target ") + unit);
  QString places = QStringLiteral("three coordinates in metres");
  if (rule.formulas)
    places = QStringLiteral(
                 "the position on the constraint, by its parameters (rad for an angle): %1.\nFractions of pi may be typed: pi/2, 3*pi/4")
                 .arg(unit);
  if (kind == constraints::ConstraintKind::Curve) places += QStringLiteral(".\n\"0.2 m\" means 0.2 m along the curve, counted from the %1");
  places += QStringLiteral(".\nThe position can also be dragged in the scene while no run is open.");
  start_->setToolTip(kind == constraints::ConstraintKind::Curve ? places.arg(QStringLiteral("target")) : places);
  target_->setToolTip(kind == constraints::ConstraintKind::Curve ? places.arg(QStringLiteral("start")) : places);
  const QString length = lengthOfReach(constraint, task);
  length_->setText(length);
  length_->setVisible(!length.isEmpty());
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
