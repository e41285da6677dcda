#pragma once
#include <QList>
#include <QObject>
#include <QPointer>
#include <optional>
#include <vector>

#include "gui/model/model_reader.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene/scene_view.h"
#include "gui/scene_plan/late_cursor.h"
#include "gui/scene_plan/scene_plan.h"
#include "gui/subject/subject_window.h"
#include "gui/widgets/qt_names.h"
#include "network/link/station_sink.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::gui::app {

/// All pictures of the scene: the experimenter's and, while it is open, the subject's with separate words.
class Screens : public QObject {
  Q_OBJECT
 public:
  explicit Screens(scene::SceneView& main);
  ~Screens() override;

  /// Builds a new picture with the hand at rest at the start. `blockPlaces` are the starts and targets [m] of all trials of the plan's block.
  /// The camera stays while these are the same.
  void showExperiment(const experiment::CompiledExperiment& experiment, const std::vector<Vec3>& blockPlaces);
  /// The index from 0 of the hand at this station. The other hands are at other stations.
  void setOwnHand(int hand) { options_.ownHand = hand; }
  /// The folder of a scene file that is named without a folder.
  void lookIn(const QString& folder) { folder_ = folder; }
  /// The object back at the start: no run is open.
  void showRest();
  /// Moves the actors. `others`: hands at other stations.
  void showState(const haptics::TickState& state, const network::OtherHands& others = {});
  void showOverlay(const scene::OverlayState& experimenters, const scene::OverlayState& subjects);
  /// The keys that work on the subject's screen as they do in the main window.
  void setSubjectsActions(const QList<QAction*>& actions) { actions_ = actions; }
  /// Draws masses beside one another, for the eye only, as seen from the present camera.
  void setSideBySide(bool on);
  /// Draws the forces on the hand for the experimenter. On by default.
  void setForcesShown(bool on);
  void toggleSubject();
  /// Opens the subject's screen on the monitor of that name, or moves it there.
  void showSubjectOn(const QString& screen);
  void closeSubject();
  const scene::OverlayState& overlay() const { return overlay_; }
  /// Of the experiment's scene file.
  model::ModelReader& modelReader() { return model_; }
  /// Whether masses are at the same position, so that one hides the others.
  bool massesHide() const;

 Q_SIGNALS:
  /// As SceneView::handDragged, from whichever picture.
  void handDragged(double x, double y, double z, qint64 eventMs);
  /// Start or target was dragged to this place: constraint parameters, or metres without a constraint.
  void placeChosen(reachlab::gui::scene::TaskPlace place, const std::vector<double>& q);
  /// Masses are drawn side by side, or forces are shown, or no longer.
  void optionsChanged();
  /// Faults of a scene file.
  void said(const QString& sentence);

 private:
  void rebuild(bool keepsView = false);
  void showPatch(const haptics::TickState* state);
  void showSubjectsFrame(trial::Phase phase);
  void openSubject(const QString& screen);
  void mirror();
  void dragPlace(scene::TaskPlace place, const QPointF& pixel);
  void leavePlace(scene::TaskPlace place);

  scene::SceneView& main_;
  QPointer<subject::SubjectWindow> subject_;
  std::optional<experiment::CompiledExperiment> experiment_;
  scene::ViewOptions options_{.forces = true};
  scene::SceneFrame frame_;
  scene::LateCursor cursor_;
  scene::OverlayState overlay_, subjectsOverlay_;
  std::optional<std::vector<double>> dragged_;  // where start or target is being dragged
  QList<QAction*> actions_;
  QString folder_;
  model::ModelReader model_;
  QLabel* mirror_;  // the subject's screen, small, in a corner of the experimenter's
  QTimer* mirrorTimer_;
};

}  // namespace reachlab::gui::app
