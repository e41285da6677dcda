#include "gui/docks/coupling_dock.h"

#include <QFormLayout>

#include "gui/widgets/fault_label.h"
#include "gui/widgets/unit_spin_box.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {

CouplingDock::CouplingDock(QWidget* parent) : Dock(QStringLiteral("Coupling"), QStringLiteral("couplingDock"), parent) {
  auto* body = new QWidget;
  auto* form = new QFormLayout(body);
  stiffness_ = new widgets::UnitSpinBox(0, 1e6, QStringLiteral("N/m"));
  stiffness_->setObjectName(QStringLiteral("couplingStiffness"));
  damping_ = new widgets::UnitSpinBox(0, 1e5, QStringLiteral("N s/m"));
  form->addRow(QStringLiteral("stiffness"), stiffness_);
  form->addRow(QStringLiteral("damping"), damping_);
  faults()->setObjectName(QStringLiteral("couplingFaults"));
  form->addRow(faults());
  stiffness_->setName(QStringLiteral("stiffness"));
  damping_->setName(QStringLiteral("damping"));
  for (auto* number : {stiffness_, damping_}) faults()->watch(number);
  stiffness_->setToolTip(QStringLiteral("spring between the hand and the mass that it drives"));
  damping_->setToolTip(QStringLiteral("damper beside this spring"));
  setBody(body);
  const auto tell = [this] {
    experiment::Experiment changed = shown();
    changed.coupling = experiment::Coupling{stiffness_->value(), damping_->value()};
    Q_EMIT edited(changed, QStringLiteral("coupling"));
  };
  connect(stiffness_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, tell);
  connect(damping_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, tell);
}

void CouplingDock::display(const experiment::CompiledExperiment& experiment, bool editable) {
  const std::optional<experiment::Coupling>& coupling = experiment.experiment().coupling;
  body()->setEnabled(editable && coupling.has_value());
  body()->setToolTip(coupling ? QString() : QStringLiteral("the springs of a parallel object are the hand's own"));
  stiffness_->show(coupling ? coupling->stiffness : 0);
  damping_->show(coupling ? coupling->damping : 0);
}

}  // namespace reachlab::gui::docks
