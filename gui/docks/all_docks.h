#pragma once
#include <vector>

#include "gui/docks/constraint_dock.h"
#include "gui/docks/device_dock.h"
#include "gui/docks/prediction_dock.h"
#include "gui/docks/session_dock.h"
#include "gui/docks/stations_dock.h"
#include "gui/docks/trials_dock.h"
#include "gui/plot/signal_plot.h"
#include "gui/plot/velocity_plot.h"

class QMainWindow;

namespace reachlab::gui::docks {

/// The docks of the window, which owns them, and the plots in two of them.
struct Docks {
  SessionDock* session = nullptr;
  ConstraintDock* constraint = nullptr;
  PredictionDock* predictions = nullptr;
  TrialsDock* trials = nullptr;
  DeviceDock* devices = nullptr;
  plot::VelocityPlot* velocity = nullptr;  // of the trial under way, with the task's window in time
  plot::SignalPlot* signal = nullptr;      // of any signal of the run
  StationsDock* stations = nullptr;        // null where the window is none of several stations
  std::vector<Dock*> all;                  // these and those that need nothing but the experiment
};

/// Makes every dock and puts it in its place. `station`: the window is one of several stations.
Docks makeDocks(QMainWindow& window, bool station = false);

}  // namespace reachlab::gui::docks
