#pragma once
#include <QMainWindow>
#include <memory>

#include "sim/session/session.h"

namespace reachlab::gui::docks {
class ConstraintChooser;
class PredictionDock;
class SessionDock;
}  // namespace reachlab::gui::docks
namespace reachlab::gui::plot {
class VelocityPlot;
}
namespace reachlab::gui::scene {
class SceneView;
struct OverlayState;
}  // namespace reachlab::gui::scene

namespace reachlab::gui::app {

class SessionController;

/// The window of `reachlab`: the scene in the middle, docks around it, the live plot below. It wires docks to the session and owns no
/// logic of either.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  /// Throws UsageError when the experiment cannot be read.
  explicit MainWindow(const session::SessionRequest& request, QWidget* parent = nullptr);
  ~MainWindow() override;

  SessionController& session();
  scene::SceneView& view();
  plot::VelocityPlot& plot();
  docks::PredictionDock& predictions();
  docks::SessionDock& sessionDock();
  docks::ConstraintChooser& chooser();  // made when first asked for
  scene::OverlayState overlay() const;
  /// The sentence in the bar at the top, empty when there is none.
  QString message() const;
  /// Waits for nothing; true once the criteria have been computed for the experiment as it is.
  bool predictionsReady() const;

 public Q_SLOTS:
  void nextTrial();
  /// An experiment or a plan, a file or a shipped name; what is wrong with it is said.
  void openExperiment(const QString& what);
  void chooseConstraint();
  void toggleSubjectWindow();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::app
