#include "gui/scene/scene_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QSurfaceFormat>
#include <QTimer>
#include <QVTKOpenGLNativeWidget.h>
#include <QVBoxLayout>
#include <QWheelEvent>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLight.h>
#include <vtkLightsPass.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLFXAAPass.h>
#include <vtkOverlayPass.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkSmartPointer.h>
#include <vtkTranslucentPass.h>
#include <vtkVersion.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "gui/scene/scene_actors.h"
#include "gui/scene/software_canvas.h"
#include "gui/widgets/colours.h"

namespace reachlab::gui::scene {
namespace {

constexpr double kGrip = 11;  // pixels about a place in which the pointer takes hold of it
constexpr int kClick = 3;     // pixels that a click may move
constexpr int kRestMs = 250;  // a picture that has not moved for so long rests
// Where the processor draws and pictures of a movement come slower than this, so many times in a row, they are drawn coarser.
constexpr int kSlowMs = 33, kSlowPictures = 4;  // 30 pictures per second look smooth
constexpr struct {
  double scale;
  bool smooth;  // the edges
} kQualities[] = {{1, true}, {0.75, true}, {0.5, true}, {0.5, false}};

// Key light from the upper left, a weak fill from the right, and a rim light from behind, all fixed to the viewer.
void addLights(vtkRenderer& renderer) {
  renderer.RemoveAllLights();
  const struct { double x, y, z, intensity; } lights[] = {{-0.6, 0.9, 1.2, 0.85}, {0.9, 0.1, 0.8, 0.32}, {0.25, 0.8, -0.9, 0.40}};
  for (const auto& l : lights) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToCameraLight();
    light->SetPosition(l.x, l.y, l.z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(l.intensity);
    renderer.AddLight(light);
  }
}

// Opaque first, then what is translucent over it: one pass over the pixels, where VTK's own order-independent way takes several.
vtkSmartPointer<vtkCameraPass> makePlainPass() {
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(vtkNew<vtkOpaquePass>());
  passes->AddItem(vtkNew<vtkTranslucentPass>());
  passes->AddItem(vtkNew<vtkOverlayPass>());
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  const auto camera = vtkSmartPointer<vtkCameraPass>::New();
  camera->SetDelegatePass(sequence);
  return camera;
}

}  // namespace

QString libraryVersion() { return QString::fromUtf8(vtkVersion::GetVTKVersion()); }

void applySurfaceFormat() { QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat()); }

SceneView::SceneView(QWidget* parent) : QWidget(parent), resting_(new QTimer(this)), plain_(makePlainPass()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  window_->SetMultiSamples(0);  // translucency needs it so; FXAA smooths the edges
  window_->SetAlphaBitPlanes(1);
  if (scene::drawsInSoftware()) {
    canvas_ = software_ = new SoftwareCanvas(*window_, this);
  } else {
    auto* card = new QVTKOpenGLNativeWidget(this);
    card->setRenderWindow(window_);
    canvas_ = card;
    renderer_->SetUseDepthPeeling(true);
    renderer_->SetMaximumNumberOfPeels(6);
    renderer_->SetOcclusionRatio(0);
  }
  layout->addWidget(canvas_);
  overlay_ = new SceneOverlay(this);
  window_->AddRenderer(renderer_);
  smooth_->SetDelegatePass(plain_);
  renderer_->SetUseFXAA(true);
  renderer_->GradientBackgroundOn();
  renderer_->GetActiveCamera();
  addLights(*renderer_);
  resting_->setSingleShot(true);
  resting_->setInterval(kRestMs);
  connect(resting_, &QTimer::timeout, this, [this] { draw(); });
  canvas_->installEventFilter(this);
  canvas_->setFocusPolicy(Qt::ClickFocus);  // a field beside the scene is left by a click into it
  setFocusPolicy(Qt::ClickFocus);
  setFocusProxy(canvas_);
  setMinimumSize(320, 198);
}

SceneView::~SceneView() = default;

void SceneView::setPlan(const ScenePlan& plan, bool resetView) {
  plan_ = plan;
  dragged_.reset();
  actors_.reset();
  actors_ = std::make_unique<ObjectActors>(*renderer_, plan, style_);
  const widgets::Colour &low = plan.colours.backgroundBottom, &high = plan.colours.backgroundTop;
  renderer_->SetBackground(low.red, low.green, low.blue);
  renderer_->SetBackground2(high.red, high.green, high.blue);
  coarse_ = slow_ = 0;
  frame_ = restingFrame(plan);
  actors_->show(frame_);
  label();
  if (resetView) resetCamera();
  else draw();
}

void SceneView::showFrame(const SceneFrame& frame) {
  // A tenth of a pixel is not seen: what rests costs nothing.
  const double unseen = 0.1 * metresPerPixel(camera_, plan_.box.centre(), high()) / std::max(1.0, canvas_->devicePixelRatioF());
  if (!actors_ || (drawn_ && !movedBeyond(unseen, frame_, frame))) return;
  frame_ = frame;
  actors_->show(frame);
  label();
  draw(true);
}

void SceneView::setGhosts(const std::vector<SceneFrame>& ghosts) {
  if (actors_ && actors_->showGhosts(ghosts)) drawn_ = false;
}

void SceneView::setSurfaceStyle(SurfaceStyle style) {
  style_ = style;
  if (!actors_) return;
  const SceneFrame kept = frame_;
  setPlan(ScenePlan(plan_), false);
  showFrame(kept);
}

void SceneView::resetCamera() { lookFrom(plan_.viewFrom); }

void SceneView::fit() { lookFrom(camera_.position - camera_.focus); }

void SceneView::lookAlong(char axis) { lookFrom(axis == 'x' ? Vec3{1, 0, 0} : axis == 'y' ? Vec3{0, 1, 0} : Vec3{0, 0, 1}); }

QImage SceneView::grabScene() {
  draw();
  return grab().toImage();
}

void SceneView::setCamera(const Camera& camera) {
  camera_ = camera;
  placed_ = true;
  applyCamera();
  draw(true);
}

void SceneView::setParallel(bool parallel) {
  parallel_ = parallel;
  fit();
}

void SceneView::setStereo(bool stereo) {
  window_->SetStereoTypeToAnaglyph();
  window_->SetStereoRender(stereo);
  coarse_ = slow_ = 0;  // it costs what two pictures do
  draw();
}

void SceneView::setPlacesMovable(bool movable) {
  if (movable_ == movable) return;
  movable_ = movable;
  canvas_->setMouseTracking(movable);
  canvas_->unsetCursor();
  if (!movable && dragged_) Q_EMIT placeLeft(*std::exchange(dragged_, {}));
}

void SceneView::showPlace(TaskPlace place, const Vec3& r, const QString& words) {
  (place == TaskPlace::Start ? plan_.start : plan_.target) = r;
  placeWords_ = words;
  frame_ = restingFrame(plan_);
  if (!actors_) return;
  actors_->movePlaces(plan_.start, plan_.target);
  actors_->show(frame_);
  label();
  draw(true);
}

QPointF SceneView::pixelOf(const Vec3& world) const {
  const auto [x, y] = scene::pixelOf(camera_, world, wide(), high());
  return {x, y};
}

double SceneView::wide() const { return std::max(canvas_->width(), 1); }
double SceneView::high() const { return std::max(canvas_->height(), 1); }

// The whole scene, with the pen as it stands at the start.
void SceneView::lookFrom(const Vec3& direction) {
  std::vector<Vec3> points = plan_.seen;
  for (const Vec3& hand : {plan_.start, plan_.target}) points.push_back(penEnd(hand, plan_.handRadius));
  const double foot = plan_.bareHand || !plan_.forces.empty() ? std::min(SceneOverlay::kFootHeight, 0.12 * high()) : 0;
  camera_ = lookAtPointsBelow(overlay_->headHeight() + foot, points, 0.06 * plan_.size, direction, wide(), high(), parallel_);
  pan(camera_, 0, -foot, high());
  applyCamera();
  draw();
}

void SceneView::applyCamera() {
  vtkCamera* c = renderer_->GetActiveCamera();
  c->SetPosition(camera_.position.x, camera_.position.y, camera_.position.z);
  c->SetFocalPoint(camera_.focus.x, camera_.focus.y, camera_.focus.z);
  c->SetViewUp(camera_.up.x, camera_.up.y, camera_.up.z);
  c->SetViewAngle(camera_.angle);
  c->SetParallelProjection(camera_.parallel);
  c->SetParallelScale(0.5 * metresPerPixel(camera_, camera_.focus, high()) * high());
  renderer_->ResetCameraClippingRange();
  const CameraAxes axes = axesOf(camera_);
  std::array<QPointF, 3> directions;
  const std::array<Vec3, 3> world{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  for (std::size_t i = 0; i < 3; ++i) directions[i] = {dot(world[i], axes.right), -dot(world[i], axes.up)};
  overlay_->setView(directions, metresPerPixel(camera_, plan_.box.centre(), high()));
  label();
}

std::optional<TaskPlace> SceneView::placeAt(const QPoint& pixel) const {
  if (!movable_ || !plan_.hasTask) return std::nullopt;
  std::optional<TaskPlace> nearest;
  double least = 0;
  for (const TaskPlace place : {TaskPlace::Target, TaskPlace::Start}) {
    const QPointF off = pixelOf(placeOf(place)) - pixel;
    const double apart = std::hypot(off.x(), off.y()), grip = 1.5 * plan_.markRadius / metresPerPixel(camera_, placeOf(place), high());
    if (apart > std::max(kGrip, grip) || (nearest && apart >= least)) continue;
    nearest = place;
    least = apart;
  }
  return nearest;
}

// Masses over one another look like one.
void SceneView::label() {
  if (!placeWords_.isEmpty() && dragged_) return overlay_->setLabel(placeWords_, pixelOf(placeOf(*dragged_)) + QPointF(0, kGrip));
  const int count = massesAtOnePlace(plan_, frame_);
  if (count == 0) return overlay_->setLabel({}, {});
  const Vec3 at = drawnPlace(plan_, frame_, static_cast<std::size_t>(count) - 1);
  const double radius = plan_.massRadius.back() / metresPerPixel(camera_, at, high());
  overlay_->setLabel(QStringLiteral("%1 masses").arg(count), pixelOf(at) + QPointF(0, radius));
}

// A movement that the processor cannot follow is drawn coarser until it rests.
void SceneView::adapt() {
  const qint64 ms = sinceMoving_.isValid() ? sinceMoving_.restart() : (sinceMoving_.start(), 0);
  if (ms > 4 * kRestMs) return;  // it was no movement before
  slow_ = ms > kSlowMs ? slow_ + 1 : 0;
  if (slow_ < kSlowPictures || coarse_ + 1 >= static_cast<int>(std::size(kQualities))) return;
  ++coarse_;
  slow_ = 0;
}

// Where the processor draws, a movement that is too slow loses resolution first and smooth edges last.
void SceneView::draw(bool moving) {
  drawn_ = false;
  if (!canvas_->isVisible()) return;
  const bool rough = moving && software_ != nullptr;
  const bool stereo = window_->GetStereoRender() != 0;  // VTK's own pass alone moves the camera from eye to eye
  if (stereo) renderer_->SetPass(nullptr);
  if (software_ != nullptr) {
    if (rough) adapt();
    const auto [scale, smoothed] = kQualities[rough ? coarse_ : 0];
    if (!stereo && smoothed) renderer_->SetPass(smooth_);
    if (!stereo && !smoothed) renderer_->SetPass(plain_);
    software_->setScale(scale);
  }
  if (rough) resting_->start();
  window_->Render();
  drawn_ = true;
  ++pictures_;
}

void SceneView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  overlay_->setGeometry(rect());
  overlay_->raise();
  if (!placed_) resetCamera();
  else applyCamera();
}

bool SceneView::eventFilter(QObject* watched, QEvent* event) {
  if (watched != canvas_) return QWidget::eventFilter(watched, event);
  switch (event->type()) {
    case QEvent::MouseButtonPress: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      lastAt_ = pressedAt_ = mouse->pos();
      if (mouse->button() != Qt::LeftButton || mouse->modifiers().testFlag(Qt::ShiftModifier)) return true;
      dragged_ = placeAt(mouse->pos());
      moved_ = false;
      reaching_ = !dragged_;
      handAtPress_ = ownHand(frame_);
      if (dragged_) canvas_->setCursor(Qt::ClosedHandCursor);
      return true;
    }
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const QPoint now = mouse->pos(), moved = now - lastAt_;
      lastAt_ = now;
      if (dragged_) {
        moved_ = moved_ || (now - pressedAt_).manhattanLength() > kClick;
        if (moved_ && mouse->buttons().testFlag(Qt::LeftButton)) Q_EMIT placeDragged(*dragged_, now);
        return true;
      }
      if (movable_ && mouse->buttons() == Qt::NoButton) {
        if (placeAt(now)) canvas_->setCursor(Qt::OpenHandCursor);
        else canvas_->unsetCursor();
      }
      if (reaching_ && mouse->buttons().testFlag(Qt::LeftButton)) {
        // Relative to where the hand was taken hold of, so that pressing beside it does not make it jump.
        const Vec3 from = pointUnder(camera_, handAtPress_, pressedAt_.x(), pressedAt_.y(), wide(), high());
        const Vec3 to = pointUnder(camera_, handAtPress_, now.x(), now.y(), wide(), high());
        const Vec3 hand = handAtPress_ + (to - from);
        Q_EMIT handDragged(hand.x, hand.y, hand.z, static_cast<qint64>(mouse->timestamp()));
        return true;
      }
      if (mouse->buttons() == Qt::NoButton) return true;
      const bool panning = mouse->buttons().testFlag(Qt::MiddleButton) || mouse->modifiers().testFlag(Qt::ShiftModifier);
      if (panning) pan(camera_, moved.x(), moved.y(), high());
      else turn(camera_, moved.x(), moved.y(), high());
      setCamera(camera_);
      return true;
    }
    case QEvent::KeyPress:
      if (!dragged_ || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape) return QWidget::eventFilter(watched, event);
      canvas_->unsetCursor();
      Q_EMIT placeLeft(*std::exchange(dragged_, {}));
      return true;
    case QEvent::MouseButtonRelease:
      if (static_cast<QMouseEvent*>(event)->button() != Qt::LeftButton) return true;
      reaching_ = false;
      if (!dragged_) return true;
      canvas_->unsetCursor();
      Q_EMIT placeDropped(*std::exchange(dragged_, {}));
      return true;
    case QEvent::MouseButtonDblClick: return true;
    case QEvent::Wheel:
      zoom(camera_, std::pow(1.0015, static_cast<QWheelEvent*>(event)->angleDelta().y()));
      setCamera(camera_);
      return true;
    default: return QWidget::eventFilter(watched, event);
  }
}

}  // namespace reachlab::gui::scene
