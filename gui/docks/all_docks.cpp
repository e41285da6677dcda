#include "gui/docks/all_docks.h"

#include <QMainWindow>

#include "gui/docks/constraint_dock.h"
#include "gui/docks/coupling_dock.h"
#include "gui/docks/device_dock.h"
#include "gui/docks/environment_dock.h"
#include "gui/docks/object_dock.h"
#include "gui/docks/prediction_dock.h"
#include "gui/docks/session_dock.h"
#include "gui/docks/signal_dock.h"
#include "gui/docks/stations_dock.h"
#include "gui/docks/task_dock.h"
#include "gui/docks/trials_dock.h"
#include "gui/docks/velocity_dock.h"

namespace reachlab::gui::docks {

Docks makeDocks(QMainWindow& window, bool station) {
  Docks docks;
  const auto add = [&](auto* dock, Qt::DockWidgetArea area) {
    window.addDockWidget(area, dock);
    docks.all.push_back(dock);
    return dock;
  };
  window.setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
  window.setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  docks.velocity = add(new VelocityDock(&window), Qt::BottomDockWidgetArea);
  docks.signal = add(new SignalDock(&window), Qt::BottomDockWidgetArea);
  window.tabifyDockWidget(docks.velocity, docks.signal);
  if (station) {
    docks.stations = add(new StationsDock(&window), Qt::BottomDockWidgetArea);
    window.tabifyDockWidget(docks.velocity, docks.stations);
    docks.stations->raise();
  } else {
    docks.velocity->raise();
  }
  docks.session = add(new SessionDock(&window), Qt::LeftDockWidgetArea);
  docks.constraint = add(new ConstraintDock(&window), Qt::LeftDockWidgetArea);
  docks.predictions = add(new PredictionDock(&window), Qt::LeftDockWidgetArea);
  docks.trials = add(new TrialsDock(&window), Qt::LeftDockWidgetArea);
  docks.devices = add(new DeviceDock(&window), Qt::LeftDockWidgetArea);
  window.tabifyDockWidget(docks.predictions, docks.trials);
  window.tabifyDockWidget(docks.trials, docks.devices);
  docks.predictions->raise();
  Dock* object = add(new ObjectDock(&window), Qt::RightDockWidgetArea);
  Dock* coupling = add(new CouplingDock(&window), Qt::RightDockWidgetArea);
  Dock* task = add(new TaskDock(&window), Qt::RightDockWidgetArea);
  window.tabifyDockWidget(task, add(new EnvironmentDock(&window), Qt::RightDockWidgetArea));
  task->raise();
  window.resizeDocks({docks.velocity}, {270}, Qt::Vertical);
  window.resizeDocks({docks.session, docks.constraint, docks.predictions}, {1, 190, 260},
                     Qt::Vertical);  // the session has its least height
  window.resizeDocks({object, coupling, task}, {270, 110, 380}, Qt::Vertical);
  window.resizeDocks({docks.session, object}, {378, 300}, Qt::Horizontal);
  return docks;
}

}  // namespace reachlab::gui::docks
