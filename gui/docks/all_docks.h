#pragma once
#include <vector>

class QMainWindow;

namespace reachlab::gui::plot {
class SignalPlot;
class VelocityPlot;
}  // namespace reachlab::gui::plot

namespace reachlab::gui::docks {

class ConstraintDock;
class DeviceDock;
class Dock;
class PredictionDock;
class SessionDock;
class StationsDock;
class TrialsDock;

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
