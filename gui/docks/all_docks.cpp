#include "gui/docks/all_docks.h"

#include <QMainWindow>
#include <functional>
#include <string>
#include <utility>

#include "gui/docks/experiment_docks.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {

namespace {

// Holds one plot. `show` tells the plot about the experiment.
class PlotDock : public Dock {
 public:
  using Show = std::function<void(const experiment::Experiment&)>;
  PlotDock(const QString& title, const QString& name, QWidget* plot, Show show, QWidget* parent)
      : Dock(title, name, parent), show_(std::move(show)) {
    setBody(plot, false);
  }

 private:
  void display(const experiment::CompiledExperiment& experiment, bool) override { show_(experiment.experiment()); }
  Show show_;
};

}  // namespace

Docks makeDocks(QMainWindow& window, bool station) {
  Docks docks;
  const auto add = [&](auto* dock, Qt::DockWidgetArea area) {
    window.addDockWidget(area, dock);
    docks.all.push_back(dock);
    return dock;
  };
  window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  docks.velocity = new plot::VelocityPlot;
  const auto showTask = [plot = docks.velocity, name = std::string()](const experiment::Experiment& e) mutable {
    const experiment::Task task = e.task.value_or(experiment::Task{});
    if (std::exchange(name, e.name) != name) plot->forgetTrials();
    plot->setTask(task.duration, task.tolerance.time);
  };
  docks.signal = new plot::SignalPlot;
  const auto showMasses = [plot = docks.signal](const experiment::Experiment& e) {
    plot->setMasses(static_cast<int>(e.object.masses.size()));
  };
  Dock* velocity = add(new PlotDock("Velocity", "plotDock", docks.velocity, showTask, &window), Qt::BottomDockWidgetArea);
  Dock* front = velocity;
  window.tabifyDockWidget(velocity,
                          add(new PlotDock("Signals", "signalDock", docks.signal, showMasses, &window), Qt::BottomDockWidgetArea));
  if (station) {
    front = docks.stations = add(new StationsDock(&window), Qt::BottomDockWidgetArea);
    window.tabifyDockWidget(velocity, front);
  }
  front->raise();
  docks.session = add(new SessionDock(&window), Qt::LeftDockWidgetArea);
  docks.constraint = add(new ConstraintDock(&window), Qt::LeftDockWidgetArea);
  docks.predictions = add(new PredictionDock(&window), Qt::LeftDockWidgetArea);
  docks.trials = add(new TrialsDock(&window), Qt::LeftDockWidgetArea);
  docks.devices = add(new DeviceDock(&window), Qt::LeftDockWidgetArea);
  window.tabifyDockWidget(docks.predictions, docks.trials);
  window.tabifyDockWidget(docks.trials, docks.devices);
  docks.predictions->raise();
  Dock* object = add(makeObjectDock(&window), Qt::RightDockWidgetArea);
  Dock* coupling = add(makeCouplingDock(&window), Qt::RightDockWidgetArea);
  Dock* task = add(makeTaskDock(&window), Qt::RightDockWidgetArea);
  window.tabifyDockWidget(task, add(makeEnvironmentDock(&window), Qt::RightDockWidgetArea));
  task->raise();
  window.resizeDocks({velocity}, {270}, Qt::Vertical);
  window.resizeDocks({docks.session, docks.constraint, docks.predictions}, {1, 190, 260},
                     Qt::Vertical);  // the session has its least height
  window.resizeDocks({object, coupling, task}, {270, 110, 380}, Qt::Vertical);
  window.resizeDocks({docks.session, object}, {378, 300}, Qt::Horizontal);
  return docks;
}

}  // namespace reachlab::gui::docks
