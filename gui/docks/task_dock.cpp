#include <QFormLayout>
#include <QLabel>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/geometry/arc_length.h"
#include "constraints/geometry/task_path.h"
#include "gui/docks/experiment_docks.h"
#include "gui/docks/form_dock.h"
#include "gui/widgets/named.h"
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
    return words(norm(placeOn(constraint, task.target) - placeOn(constraint, task.start)), "from start to target");
  try {
    return words(constraints::ArcLength(constraint, task.start.at(0), task.target.at(0)).length(), "along the curve");
  } catch (const Error&) {  // no value between them: said where the scene is compiled
    return {};
  }
}

class TaskDock : public FormDock {
 public:
  explicit TaskDock(QWidget* parent) : FormDock("Task", "taskDock", parent), length_(widgets::named<QLabel>("taskLength")) {
    start_ = addList("start", "taskStart", {}, task_.start);
    target_ = addList("target", "taskTarget", {}, task_.target);
    length_->setProperty("role", "quiet");
    form().addRow(QString(), length_);
    addList("via x y z [m]", "taskVia", "Places that the last mass, or a bare hand, passes in this order before it arrives: x y z of each.",
            via_,
            [this] {
              task_.via.clear();
              for (std::size_t i = 0; i + 2 < via_.size(); i += 3) task_.via.push_back({via_[i], via_[i + 1], via_[i + 2]});
            })
        ->setRule({.list = "via", .most = 60, .multipleOf = 3});
    viaRadius_ =
        addNumber({"± via", "radius of via", 1e-5, 1, "m", "Distance within which such a place counts as passed."}, task_.viaRadius);
    addNumber({"time T", "time T", 0.05, 60, "s", "duration of the movement that is asked for, from its onset"}, task_.duration)
        ->setObjectName("taskDuration");
    addNumber({"± ΔT", "ΔT", 0.001, 30, "s", "how much earlier or later than T the movement may end"}, task_.tolerance.time);
    addNumber({"± Δx", "Δx", 1e-5, 1, "m", "how near the target every mass must be at the end"}, task_.tolerance.position);
    addNumber({"± Δv", "Δv", 1e-5, 10, "m/s", "how slow every mass must be at the end"}, task_.tolerance.velocity);
    endForm();
  }

 private:
  void fill(const experiment::CompiledExperiment& experiment) override {
    if (!experiment.experiment().task) return;
    task_ = *experiment.experiment().task;
    const constraints::Constraint& constraint = experiment.constraint();
    const bool free = constraint.kind == constraints::ConstraintKind::Free;
    widgets::NumberListRule rule{.formulas = !free};
    if (free) rule.names = QStringList{"x", "y", "z"};
    else
      for (const std::string& name : constraints::variablesOf(constraint.kind)) rule.names << QString::fromStdString(name);
    rule.fewest = rule.most = static_cast<std::size_t>(rule.names.size());
    showPlace(*start_, "start", task_.start, "target", task_.target, constraint, rule);
    showPlace(*target_, "target", task_.target, "start", task_.start, constraint, rule);
    const QString length = lengthOfReach(constraint, task_);
    length_->setText(length);
    length_->setVisible(!length.isEmpty());
    via_.clear();
    for (const Vec3& place : task_.via) via_.insert(via_.end(), {place.x, place.y, place.z});
    viaRadius_->setEnabled(!via_.empty());
  }

  // `other`: the other end of the reach, from which lengths are counted.
  void showPlace(widgets::NumberListEdit& field, const QString& name, const std::vector<double>& place, const QString& otherName,
                 const std::vector<double>& other, const constraints::Constraint& constraint, widgets::NumberListRule rule) {
    // A formula's own measure, rad where it is an angle.
    const QString unit = rule.names.join(QLatin1Char(' ')) + (rule.formulas ? " [1]" : " [m]");
    QString tip = "three coordinates in metres";
    if (rule.formulas)
      tip = QStringLiteral(
                "the position on the constraint, by its parameters (rad for an angle): %1.\nFractions of pi may be typed: pi/2, 3*pi/4")
                .arg(unit);
    if (constraint.kind == constraints::ConstraintKind::Curve)
      tip += QStringLiteral(".\n\"0.2 m\" means 0.2 m along the curve, counted from the %1").arg(otherName);
    field.setToolTip(tip + ".\nThe position can also be dragged in the scene while no run is open.");
    qobject_cast<QLabel*>(form().labelForField(&field))->setText(name + QLatin1Char(' ') + unit);
    rule.list = name;
    rule.atLength = lengthsFrom(constraint, other, place);
    field.setRule(rule);
  }

  void tell() override {
    edit("task", [this](experiment::Experiment& e) { e.task = task_; });
  }

  experiment::Task task_;    // as entered
  std::vector<double> via_;  // its places, as entered
  widgets::NumberListEdit *start_, *target_;
  widgets::UnitSpinBox* viaRadius_;
  QLabel* length_;
};

}  // namespace

Dock* makeTaskDock(QWidget* parent) { return new TaskDock(parent); }

}  // namespace reachlab::gui::docks
