#pragma once
#include <QWidget>
#include <memory>

#include "gui/scene/camera.h"
#include "gui/scene/object_actors.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {

/// Of VTK, as it runs: "9.1.0".
QString libraryVersion();
/// Sets the OpenGL format of the scene. Call it before the QApplication is made.
void applySurfaceFormat();

enum class TaskPlace { Start, Target };

/// The scene in three dimensions. Left drag moves the hand (handDragged), right drag turns, middle drag (or shift) pans, the wheel zooms.
class SceneView : public QWidget {
  Q_OBJECT
 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  /// Builds the actors anew and, if `resetCamera`, looks at all of it.
  void setPlan(const ScenePlan& plan, bool resetCamera = true);
  /// Moves the actors without building any. Draws only if a visible movement happened.
  void showFrame(const SceneFrame& frame);
  /// Shows other trials faintly until the next plan. The next `showFrame` or `renderNow` draws them.
  void setGhosts(const std::vector<SceneFrame>& ghosts);
  void setOverlay(const OverlayState& state);
  void setSurfaceStyle(SurfaceStyle style);
  void setOverlayVisible(bool visible);
  void setTextScale(double scale);
  void resetCamera();
  /// The whole scene from the side that is looked from now.
  void fit();
  /// From the side of x, y or z, or 0: the usual view.
  void lookAlong(char axis);
  /// Switches to a parallel projection and fits the whole scene.
  void setParallel(bool parallel);
  /// For red and cyan glasses.
  void setStereo(bool stereo);
  /// How often the scene was drawn.
  std::int64_t picturesDrawn() const;
  /// Draws now. For screenshots and tests.
  void renderNow();
  QImage grabScene();

  const Camera& camera() const;
  void setCamera(const Camera& camera);
  const ScenePlan& plan() const;
  SceneFrame frame() const;
  /// Whether start and target can be taken hold of with the left button.
  void setPlacesMovable(bool movable);
  /// Draws start or target at `r` until the next plan, with `words` beside it. Hand and masses that rest at the start go with it.
  void showPlace(TaskPlace place, const Vec3& r, const QString& words);
  /// Software drawing is slow: fewer frames per second, and a cheaper translucency.
  bool drawsInSoftware() const;
  /// Where a world point is drawn, in this widget's coordinates.
  QPointF pixelOf(const Vec3& world) const;

 Q_SIGNALS:
  /// The pointer with the left button down: where the hand is asked to be [m], in the plane through the hand that faces the viewer.
  /// `eventMs`: when, by the window system's own clock.
  void handDragged(double x, double y, double z, qint64 eventMs);
  /// Start or target is dragged to a pixel of this widget, is let go there, or goes back where it was (Escape).
  void placeDragged(reachlab::gui::scene::TaskPlace place, const QPointF& pixel);
  void placeDropped(reachlab::gui::scene::TaskPlace place);
  void placeLeft(reachlab::gui::scene::TaskPlace place);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  QSize sizeHint() const override { return {900, 620}; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::scene
