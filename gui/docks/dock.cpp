#include "gui/docks/dock.h"

#include "gui/widgets/fault_label.h"

namespace reachlab::gui::docks {

Dock::Dock(const QString& title, const QString& name, QWidget* parent) : QDockWidget(title, parent), faults_(new widgets::FaultLabel) {
  setObjectName(name);
  faults_->setParent(this);  // until the dock gives it a place
  faults_->hide();
}

void Dock::setBody(QWidget* body) {
  body_ = body;
  setWidget(body);
}

void Dock::showExperiment(const experiment::CompiledExperiment& experiment, bool editable) {
  shown_ = experiment.experiment();
  display(experiment, editable);
}

void Dock::showFaults(const QStringList& faults) { faults_->setFaults(faults); }

}  // namespace reachlab::gui::docks
