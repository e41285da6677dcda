#include "gui/docks/coupling_dock.h"

#include <QFormLayout>

#include "gui/widgets/fault_label.h"
#include "gui/widgets/unit_spin_box.h"

namespace reachlab::gui::docks {

CouplingDock::CouplingDock(QWidget* parent) : QDockWidget(QStringLiteral("Coupling of hand and object"), parent) {
  setObjectName(QStringLiteral("couplingDock"));
  auto* body = new QWidget;
  auto* form = new QFormLayout(body);
  stiffness_ = new widgets::UnitSpinBox(0, 1e6, QStringLiteral("N/m"));
  stiffness_->setObjectName(QStringLiteral("couplingStiffness"));
  damping_ = new widgets::UnitSpinBox(0, 1e5, QStringLiteral("N s/m"));
  form->addRow(QStringLiteral("stiffness"), stiffness_);
  form->addRow(QStringLiteral("damping"), damping_);
  faults_ = new widgets::FaultLabel;
  faults_->setObjectName(QStringLiteral("couplingFaults"));
  form->addRow(faults_);
  stiffness_->setName(QStringLiteral("stiffness"));
  damping_->setName(QStringLiteral("damping"));
  for (auto* number : {stiffness_, damping_}) faults_->watch(number);
  setWidget(body);
  const auto tell = [this] { Q_EMIT edited({stiffness_->value(), damping_->value()}); };
  connect(stiffness_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, tell);
  connect(damping_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, tell);
}

void CouplingDock::setCoupling(const std::optional<experiment::Coupling>& coupling) {
  widget()->setEnabled(coupling.has_value());
  widget()->setToolTip(coupling ? QString() : QStringLiteral("the springs of a parallel object are the hand's own"));
  stiffness_->show(coupling ? coupling->stiffness : 0);
  damping_->show(coupling ? coupling->damping : 0);
}

void CouplingDock::setFaults(const QStringList& faults) { faults_->setFaults(faults); }

}  // namespace reachlab::gui::docks
