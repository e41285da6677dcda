#pragma once
#include <QObject>
#include <QPointer>

#include "sim/session/session.h"

namespace reachlab::gui::docks {
class SessionDock;
}
namespace reachlab::gui::plan {
class PlanComposer;
class StartPage;
}  // namespace reachlab::gui::plan
namespace reachlab::gui::scene {
class SceneView;
}

namespace reachlab::gui::app {

class SessionController;

/// A plan in the window: its start page over the scene while no run is open, and the dialog in which one is composed.
class PlanPages : public QObject {
  Q_OBJECT
 public:
  PlanPages(SessionController& session, docks::SessionDock& dock, scene::SceneView& view);
  /// Shows or hides the start page; looks at the disk again where subject, session or plan are others, or a run has ended. From a timer.
  void refresh();
  /// What is recorded has changed.
  void forget() { known_ = false; }
  /// The start page offers to go on with what was begun.
  bool resumes() const;
  /// `file`: where the plan stands that is open; empty: shipped, or no plan.
  void compose(QWidget* window, const QString& file);

 Q_SIGNALS:
  void beginRequested();
  void resumeRequested();
  void composeRequested();
  void composed(const QString& file);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  SessionController& session_;
  docks::SessionDock& dock_;
  scene::SceneView& view_;
  plan::StartPage* page_;
  QPointer<plan::PlanComposer> composer_;
  bool known_ = false;
  session::SessionPlace knownPlace_;
  std::optional<int> knownDay_;
  std::string knownPlan_;
};

}  // namespace reachlab::gui::app
