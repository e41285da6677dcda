#include "gui/docks/object_dock.h"

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include "gui/scene_plan/definition_reach.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/named.h"
#include "gui/widgets/number_list_edit.h"
#include "gui/widgets/unit_spin_box.h"

namespace reachlab::gui::docks {
namespace {

// As many springs as the kind needs; new ones like the last.
void fitSprings(experiment::Object& object) {
  const std::size_t masses = object.masses.size();
  const std::size_t wanted = object.kind == experiment::ObjectKind::Parallel              ? masses
                             : object.kind == experiment::ObjectKind::Chain && masses > 0 ? masses - 1
                                                                                          : 0;
  object.stiffness.resize(wanted, object.stiffness.empty() ? 600 : object.stiffness.back());
  object.damping.resize(wanted, object.damping.empty() ? 0 : object.damping.back());
}

}  // namespace

ObjectDock::ObjectDock(QWidget* parent) : Dock(QStringLiteral("Object"), QStringLiteral("objectDock"), parent) {
  auto* body = new QWidget;
  auto* form = new QFormLayout(body);
  kind_ = widgets::named<QComboBox>("objectKind");
  kind_->addItems(
      {QStringLiteral("point"), QStringLiteral("chain"), QStringLiteral("parallel"), QStringLiteral("body"), QStringLiteral("none")});
  masses_ = widgets::named<widgets::NumberListEdit>("masses");
  stiffness_ = widgets::named<widgets::NumberListEdit>("stiffness");
  damping_ = new widgets::NumberListEdit;
  viscosity_ = new widgets::UnitSpinBox(0, 1e4, QStringLiteral("N s/m"));
  auto* gravity = new QHBoxLayout;
  for (auto& g : gravity_) {
    g = new widgets::UnitSpinBox(-100, 100, {});
    g->setMinimumWidth(54);
    g->setButtonSymbols(QAbstractSpinBox::NoButtons);
    gravity->addWidget(g);
  }
  form->addRow(QStringLiteral("kind"), kind_);
  form->addRow(QStringLiteral("masses [kg]"), masses_);
  form->addRow(QStringLiteral("springs [N/m]"), stiffness_);
  form->addRow(QStringLiteral("dampers [N s/m]"), damping_);
  form->addRow(QStringLiteral("viscosity"), viscosity_);
  form->addRow(QStringLiteral("gravity [m/s²]"), gravity);
  faults()->setObjectName(QStringLiteral("objectFaults"));
  form->addRow(faults());
  viscosity_->setName(QStringLiteral("viscosity"));
  for (std::size_t i = 0; i < 3; ++i) gravity_[i]->setName(QStringLiteral("gravity %1").arg(QLatin1Char("xyz"[i])));
  for (auto* list : {masses_, stiffness_, damping_}) faults()->watch(list);
  for (auto* number : {viscosity_, gravity_[0], gravity_[1], gravity_[2]}) faults()->watch(number);
  masses_->setToolTip(QStringLiteral("first: the mass that the hand drives. Example: 0.6 0.6 0.6, or 5 x 0.6"));
  stiffness_->setToolTip(QStringLiteral("chain: between neighbours, one fewer than masses; parallel: each mass to the hand"));
  kind_->setToolTip(
      QStringLiteral("point: one mass. chain: masses in a row, and the hand drives the first. parallel: every mass hangs on the hand.\n"
                     "body: one mass that can turn. none: the hand alone"));
  damping_->setToolTip(QStringLiteral("dampers beside the springs, in the same order"));
  viscosity_->setToolTip(QStringLiteral("drag on every mass, per speed of the mass"));
  for (std::size_t i = 0; i < 3; ++i) gravity_[i]->setToolTip(QStringLiteral("gravity along %1; y points up").arg(QLatin1Char("xyz"[i])));
  setBody(body);

  connect(kind_, qOverload<int>(&QComboBox::activated), this, [this] {
    object_ = shown().object;  // a kind that was refused leaves nothing behind
    object_.kind = static_cast<experiment::ObjectKind>(kind_->currentIndex());
    if (object_.kind == experiment::ObjectKind::Point || object_.kind == experiment::ObjectKind::Body) object_.masses.resize(1, 1.0);
    if (object_.kind == experiment::ObjectKind::Parallel)
      object_.masses.resize(std::max<std::size_t>(2, object_.masses.size()), object_.masses.empty() ? 1.0 : object_.masses.back());
    if (object_.kind == experiment::ObjectKind::Body && object_.inertia[0][0] == 0)
      for (std::size_t i = 0; i < 3; ++i) object_.inertia[i][i] = 4e-4 * object_.masses[0];
    if (object_.kind == experiment::ObjectKind::None) object_.masses.clear();
    else if (object_.masses.empty()) object_.masses = {1};
    fitSprings(object_);
    tell();
  });
  connect(masses_, &widgets::NumberListEdit::numbersEdited, this, [this] {
    object_.masses = *masses_->numbers();
    fitSprings(object_);
    tell();
  });
  connect(stiffness_, &widgets::NumberListEdit::numbersEdited, this, [this] {
    object_.stiffness = *stiffness_->numbers();
    object_.damping.resize(object_.stiffness.size(), 0);
    tell();
  });
  connect(damping_, &widgets::NumberListEdit::numbersEdited, this, [this] { object_.damping = *damping_->numbers(), tell(); });
  connect(viscosity_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double v) { object_.viscosity = v, tell(); });
  double Vec3::*const parts[] = {&Vec3::x, &Vec3::y, &Vec3::z};
  for (std::size_t i = 0; i < 3; ++i)
    connect(gravity_[i], qOverload<double>(&QDoubleSpinBox::valueChanged), this,
            [this, part = parts[i]](double v) { object_.gravity.*part = v, tell(); });
}

void ObjectDock::display(const experiment::CompiledExperiment& experiment, bool editable) {
  const experiment::Object& object = object_ = experiment.experiment().object;
  body()->setEnabled(editable);
  kind_->setCurrentIndex(static_cast<int>(object.kind));
  const bool springs = object.kind == experiment::ObjectKind::Chain || object.kind == experiment::ObjectKind::Parallel;
  const bool any = object.kind != experiment::ObjectKind::None;
  masses_->setEnabled(any);
  viscosity_->setEnabled(any);
  stiffness_->setEnabled(springs);
  damping_->setEnabled(springs);
  setRules();
  masses_->setNumbers(object.masses);
  stiffness_->setNumbers(object.stiffness);
  damping_->setNumbers(object.damping);
  viscosity_->show(object.viscosity);
  const double g[] = {object.gravity.x, object.gravity.y, object.gravity.z};
  for (std::size_t i = 0; i < 3; ++i) gravity_[i]->show(g[i]);
}

void ObjectDock::setRules() {
  const bool springs = object_.kind == experiment::ObjectKind::Chain || object_.kind == experiment::ObjectKind::Parallel;
  widgets::NumberListRule rule{QStringLiteral("masses"),
                               QStringLiteral("mass"),
                               {},
                               QStringLiteral("kg"),
                               0,
                               false,
                               object_.kind == experiment::ObjectKind::None ? 0u : 1u,
                               springs ? experiment::kMaxMasses : 1u};
  masses_->setRule(rule);
  rule = {QStringLiteral("springs"), QStringLiteral("spring"), {}, QStringLiteral("N/m"), 0};
  rule.fewest = rule.most = object_.stiffness.size();
  stiffness_->setRule(rule);
  rule.list = QStringLiteral("dampers");
  rule.item = QStringLiteral("damper");
  rule.unit = QStringLiteral("N s/m");
  damping_->setRule(rule);
}

void ObjectDock::tell() {
  experiment::Experiment changed = shown();
  changed.object = object_;
  // The springs of parallel masses are the hand's own.
  if (object_.kind == experiment::ObjectKind::Parallel || object_.kind == experiment::ObjectKind::None) changed.coupling.reset();
  else if (!changed.coupling) changed.coupling = scene::kNewCoupling;
  Q_EMIT edited(changed, QStringLiteral("object"));
}

}  // namespace reachlab::gui::docks
