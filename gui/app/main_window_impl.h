#pragma once
#include <chrono>
#include <functional>
#include <future>
#include <stop_token>
#include <vector>

#include "gui/app/main_window.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene/scene_plan.h"
#include "gui/app/session_controller.h"
#include "gui/app/success_sound.h"
#include "gui/plot/trial_errors.h"

class QLabel;
class QTimer;
class QUndoStack;

namespace reachlab::gui::docks {
class ConstraintDock;
class CouplingDock;
class ObjectDock;
class TaskDock;
}  // namespace reachlab::gui::docks
namespace reachlab::gui::subject {
class SubjectWindow;
}

namespace reachlab::gui::app {

/// What the main window holds and how it goes from frame to frame. Only the main window's own files include this.
struct MainWindow::Impl {
  MainWindow& window;
  SessionController session;
  scene::SceneView* view = nullptr;
  plot::VelocityPlot* plot = nullptr;
  docks::ObjectDock* object = nullptr;
  docks::CouplingDock* coupling = nullptr;
  docks::TaskDock* task = nullptr;
  docks::PredictionDock* predictions = nullptr;
  docks::SessionDock* dock = nullptr;
  docks::ConstraintDock* constraint = nullptr;
  docks::ConstraintChooser* chooser = nullptr;
  subject::SubjectWindow* subject = nullptr;
  QLabel *message = nullptr, *rate = nullptr, *ticks = nullptr, *method = nullptr, *recording = nullptr;
  QUndoStack* edits = nullptr;
  QTimer* timer = nullptr;
  SuccessSound sound;
  scene::ViewOptions viewOptions;
  scene::SceneFrame frame;
  scene::OverlayState overlay;
  plot::PathDirection path;
  std::vector<plot::TracePoint> trace;  // of the trial under way, or the last
  std::int32_t traceTrial = 0;
  std::vector<plot::CriterionForecast> forecasts;
  std::stop_source stopComputing;
  std::future<std::vector<plot::CriterionForecast>> computing;
  bool forecastsStale = true, errorsDue = false;
  int frames = 0;
  std::chrono::steady_clock::time_point nextAt{};
  bool nextPlanned = false;

  Impl(MainWindow& w, const session::SessionRequest& request) : window(w), session(request) {}

  const experiment::Task& currentTask() const;
  void say(const QString& sentence);
  void edit(const experiment::Experiment& changed, const QString& what, const std::function<void(const QStringList&)>& showFaults);
  void pushEdit(const session::Programme& before, const QString& what);
  void showExperiment();
  void rebuildScene();
  void showOverlay();
  void showStage();
  void next();
  void drain();
  void tendForecasts();
  void drawPredictions();
  void trialEnded();
  void showStatus();
  void runOpened();
  void oneFrame();

  // main_window_setup.cpp
  void makeDocks();
  void makeMenus();
  void makeStatusBar();
  void wire();
  void openExperiment(const QString& what);
  void saveExperiment();
};

}  // namespace reachlab::gui::app
