#include "gui/docks/velocity_dock.h"

#include <utility>

#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {

VelocityDock::VelocityDock(QWidget* parent)
    : Dock(QStringLiteral("Velocity"), QStringLiteral("plotDock"), parent), plot_(new plot::VelocityPlot) {
  setBody(plot_, false);
}

void VelocityDock::display(const experiment::CompiledExperiment& experiment, bool) {
  const experiment::Task task = experiment.experiment().task.value_or(experiment::Task{});
  if (std::exchange(name_, experiment.experiment().name) != name_) plot_->forgetTrials();
  plot_->setTask(task.duration, task.tolerance.time);
}

}  // namespace reachlab::gui::docks
