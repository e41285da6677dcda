#pragma once
#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include <QElapsedTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include "gui/scene/camera.h"
#include "gui/scene/object_actors.h"
#include "gui/scene/scene_overlay.h"
#include "gui/scene_plan/scene_plan.h"

class QTimer;
class vtkCameraPass;
class vtkGenericOpenGLRenderWindow;
class vtkOpenGLFXAAPass;
class vtkRenderer;

namespace reachlab::gui::scene {

class SoftwareCanvas;

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
  /// Shows other trials faintly until the next plan. The next `showFrame` or `draw` draws them.
  void setGhosts(const std::vector<SceneFrame>& ghosts);
  /// The words over the scene.
  SceneOverlay& overlay() { return *overlay_; }
  void setSurfaceStyle(SurfaceStyle style);
  void resetCamera();
  /// The whole scene from the side that is looked from now.
  void fit();
  /// From the side of x, y or z.
  void lookAlong(char axis);
  /// Switches to a parallel projection and fits the whole scene.
  void setParallel(bool parallel);
  /// For red and cyan glasses.
  void setStereo(bool stereo);
  /// How often the scene was drawn.
  std::int64_t picturesDrawn() const { return pictures_; }
  /// Draws now. `moving`: where the processor is slow, a picture of a movement may be coarser.
  void draw(bool moving = false);
  QImage grabScene();

  const Camera& camera() const { return camera_; }
  void setCamera(const Camera& camera);
  const ScenePlan& plan() const { return plan_; }
  const SceneFrame& frame() const { return frame_; }
  /// Whether start and target can be taken hold of with the left button.
  void setPlacesMovable(bool movable);
  /// Draws start or target at `r` until the next plan, with `words` beside it. Hand and masses that rest at the start go with it.
  void showPlace(TaskPlace place, const Vec3& r, const QString& words);
  /// Software drawing is slow: fewer frames per second, and a cheaper translucency.
  bool drawsInSoftware() const { return software_ != nullptr; }
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
  void lookFrom(const Vec3& direction);
  void applyCamera();
  void label();
  void adapt();
  std::optional<TaskPlace> placeAt(const QPoint& pixel) const;
  const Vec3& placeOf(TaskPlace place) const { return place == TaskPlace::Start ? plan_.start : plan_.target; }
  double wide() const;  // [pixels] of the picture
  double high() const;

  QWidget* canvas_;
  SoftwareCanvas* software_ = nullptr;  // the canvas, where the processor draws
  SceneOverlay* overlay_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  std::unique_ptr<ObjectActors> actors_;
  ScenePlan plan_;
  SceneFrame frame_;
  Camera camera_;
  SurfaceStyle style_ = SurfaceStyle::Glass;
  QTimer* resting_;
  bool placed_ = false;  // the camera has been put in place for a real size
  bool drawn_ = false;   // what is on the screen is `frame_`
  std::int64_t pictures_ = 0;
  vtkSmartPointer<vtkCameraPass> plain_;
  vtkNew<vtkOpenGLFXAAPass> smooth_;
  bool parallel_ = false;
  int coarse_ = 0, slow_ = 0;  // which quality a movement is drawn in; slow pictures in a row
  QElapsedTimer sinceMoving_;
  QPoint pressedAt_, lastAt_;
  Vec3 handAtPress_;
  bool reaching_ = false;
  bool movable_ = false;  // start and target
  std::optional<TaskPlace> dragged_;
  bool moved_ = false;  // since it was taken hold of: a click moves nothing
  QString placeWords_;
};

}  // namespace reachlab::gui::scene
