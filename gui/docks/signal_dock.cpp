#include "gui/docks/signal_dock.h"

#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {

SignalDock::SignalDock(QWidget* parent)
    : Dock(QStringLiteral("Signals"), QStringLiteral("signalDock"), parent), plot_(new plot::SignalPlot) {
  setBody(plot_, false);
}

void SignalDock::display(const experiment::CompiledExperiment& experiment, bool) {
  plot_->setMasses(static_cast<int>(experiment.experiment().object.masses.size()));
}

}  // namespace reachlab::gui::docks
