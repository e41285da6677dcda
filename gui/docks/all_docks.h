#pragma once
#include <vector>

class QMainWindow;

namespace reachlab::gui::docks {

class ConstraintDock;
class DeviceDock;
class Dock;
class PredictionDock;
class SessionDock;
class SignalDock;
class StationsDock;
class TrialsDock;
class VelocityDock;

/// The docks of the window, which owns them.
struct Docks {
  SessionDock* session = nullptr;
  ConstraintDock* constraint = nullptr;
  PredictionDock* predictions = nullptr;
  VelocityDock* velocity = nullptr;
  TrialsDock* trials = nullptr;
  DeviceDock* devices = nullptr;
  SignalDock* signal = nullptr;
  StationsDock* stations = nullptr;  // null where the window is none of several stations
  std::vector<Dock*> all;            // these and those that need nothing but the experiment
};

/// Makes every dock and puts it in its place. `station`: the window is one of several stations.
Docks makeDocks(QMainWindow& window, bool station = false);

}  // namespace reachlab::gui::docks
