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

/// A plan in the window: the start page over the scene while no run is open, and the composer dialog.
class PlanPages : public QObject {
  Q_OBJECT
 public:
  PlanPages(SessionController& session, docks::SessionDock& dock, scene::SceneView& view);
  /// Shows or hides the start page. Reads the disk again after another subject, session or plan, or after the end of a run. Called by a
  /// timer.
  void refresh();
  /// The recordings have changed.
  void forget() { known_ = false; }
  /// The start page offers to resume the session that was begun.
  bool resumes() const;
  /// `file`: the path of the open plan. Empty if the plan is shipped or there is no plan.
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
