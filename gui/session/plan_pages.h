#pragma once
#include <QObject>
#include <QPointer>
#include <optional>
#include <string>
#include <tuple>

#include "gui/docks/session_dock.h"
#include "gui/plan/plan_composer.h"
#include "gui/plan/start_page.h"
#include "gui/scene/scene_view.h"
#include "gui/session/session_controller.h"

namespace reachlab::gui::app {

/// A plan in the window: the start page over the scene while no run is open, and the composer dialog.
class PlanPages : public QObject {
  Q_OBJECT
 public:
  PlanPages(SessionController& session, docks::SessionDock& dock, scene::SceneView& view);
  /// Shows or hides the start page. Reads the disk again after another subject, session or plan, or after the end of a run. Called by a
  /// timer.
  void refresh();
  plan::StartPage& startPage() { return *page_; }
  /// The start page offers to resume the session that was begun.
  bool resumes() const;
  /// `file`: the path of the open plan. Empty if the plan is shipped or there is no plan.
  void compose(QWidget* window, const QString& file);
  /// Asks for the plan that is being composed, if it is not saved.
  bool mayBeLeft() { return !composer_ || composer_->close(); }

 Q_SIGNALS:
  void composed(const QString& file);

 private:
  SessionController& session_;
  docks::SessionDock& dock_;
  scene::SceneView& view_;
  plan::StartPage* page_;
  QPointer<plan::PlanComposer> composer_;
  using Shown = std::tuple<session::SessionPlace, std::optional<int>, std::string>;  // place, day, and text of the plan
  std::optional<Shown> shown_;                                                       // on the start page
};

}  // namespace reachlab::gui::app
