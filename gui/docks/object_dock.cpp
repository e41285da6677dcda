#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <algorithm>

#include "gui/docks/experiment_docks.h"
#include "gui/docks/form_dock.h"
#include "gui/scene_plan/definition_reach.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::docks {
namespace {

using experiment::ObjectKind;

// As many springs as the kind needs; new ones like the last.
void fitSprings(experiment::Object& object) {
  const std::size_t masses = object.masses.size();
  const std::size_t wanted = object.kind == ObjectKind::Parallel ? masses : object.kind == ObjectKind::Chain && masses > 0 ? masses - 1 : 0;
  object.stiffness.resize(wanted, object.stiffness.empty() ? 600 : object.stiffness.back());
  object.damping.resize(wanted, object.damping.empty() ? 0 : object.damping.back());
}

class ObjectDock : public FormDock {
 public:
  explicit ObjectDock(QWidget* parent) : FormDock("Object", "objectDock", parent), kind_(widgets::named<QComboBox>("objectKind")) {
    kind_->addItems({"point", "chain", "parallel", "body", "none"});
    kind_->setToolTip(
        "point: one mass. chain: masses in a row, and the hand drives the first. parallel: every mass hangs on the hand.\n"
        "body: one mass that can turn. none: the hand alone");
    connect(kind_, qOverload<int>(&QComboBox::activated), this, [this](int kind) { choose(static_cast<ObjectKind>(kind)); });
    form().addRow("kind", kind_);
    masses_ = addList("masses [kg]", "masses", "first: the mass that the hand drives. Example: 0.6 0.6 0.6, or 5 x 0.6", object_.masses,
                      [this] { fitSprings(object_); });
    stiffness_ = addList("springs [N/m]", "stiffness", "chain: between neighbours, one fewer than masses; parallel: each mass to the hand",
                         object_.stiffness, [this] { object_.damping.resize(object_.stiffness.size(), 0); });
    damping_ = addList("dampers [N s/m]", "damping", "dampers beside the springs, in the same order", object_.damping);
    viscosity_ = addNumber({"viscosity", "viscosity", 0, 1e4, "N s/m", "drag on every mass, per speed of the mass"}, object_.viscosity);
    auto* gravity = new QHBoxLayout;
    for (const auto& [axis, entry] :
         {std::pair('x', &object_.gravity.x), std::pair('y', &object_.gravity.y), std::pair('z', &object_.gravity.z)}) {
      auto* box = new widgets::UnitSpinBox(-100, 100, {});
      box->setMinimumWidth(54);
      box->setButtonSymbols(QAbstractSpinBox::NoButtons);
      gravity->addWidget(box);
      bind(box, QStringLiteral("gravity %1").arg(axis), QStringLiteral("gravity along %1; y points up").arg(axis), *entry);
    }
    form().addRow("gravity [m/s²]", gravity);
    endForm();
  }

 private:
  void choose(ObjectKind kind) {
    object_ = shown().object;  // a kind that was refused leaves nothing behind
    object_.kind = kind;
    if (kind == ObjectKind::Point || kind == ObjectKind::Body) object_.masses.resize(1, 1.0);
    if (kind == ObjectKind::Parallel)
      object_.masses.resize(std::max<std::size_t>(2, object_.masses.size()), object_.masses.empty() ? 1.0 : object_.masses.back());
    if (kind == ObjectKind::Body && object_.inertia[0][0] == 0)
      for (std::size_t i = 0; i < 3; ++i) object_.inertia[i][i] = 4e-4 * object_.masses[0];
    if (kind == ObjectKind::None) object_.masses.clear();
    else if (object_.masses.empty()) object_.masses = {1};
    fitSprings(object_);
    tell();
  }

  void fill(const experiment::CompiledExperiment& experiment) override {
    object_ = experiment.experiment().object;
    kind_->setCurrentIndex(static_cast<int>(object_.kind));
    const bool any = object_.kind != ObjectKind::None;
    const bool springs = object_.kind == ObjectKind::Chain || object_.kind == ObjectKind::Parallel;
    masses_->setEnabled(any);
    viscosity_->setEnabled(any);
    stiffness_->setEnabled(springs);
    damping_->setEnabled(springs);
    widgets::NumberListRule rule{.list = "masses", .item = "mass", .unit = "kg", .low = 0, .lowAllowed = false};
    rule.fewest = any ? 1 : 0;
    rule.most = springs ? experiment::kMaxMasses : 1;
    masses_->setRule(rule);
    rule = {.list = "springs", .item = "spring", .unit = "N/m", .low = 0};
    rule.fewest = rule.most = object_.stiffness.size();
    stiffness_->setRule(rule);
    rule.list = "dampers";
    rule.item = "damper";
    rule.unit = "N s/m";
    damping_->setRule(rule);
  }

  void tell() override {
    edit("object", [this](experiment::Experiment& e) {
      e.object = object_;
      // The springs of parallel masses are the hand's own.
      if (object_.kind == ObjectKind::Parallel || object_.kind == ObjectKind::None) e.coupling.reset();
      else if (!e.coupling) e.coupling = scene::kNewCoupling;
    });
  }

  experiment::Object object_;  // as entered
  QComboBox* kind_;
  widgets::NumberListEdit *masses_, *stiffness_, *damping_;
  widgets::UnitSpinBox* viscosity_;
};

}  // namespace

Dock* makeObjectDock(QWidget* parent) { return new ObjectDock(parent); }

}  // namespace reachlab::gui::docks
