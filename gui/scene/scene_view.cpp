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

#include <QElapsedTimer>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "gui/scene/ghost_actors.h"
#include "gui/scene/renderer_name.h"
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

struct SceneView::Impl {
  QWidget* widget = nullptr;
  SoftwareCanvas* software = nullptr;  // the widget, where the processor draws
  SceneOverlay* overlay = nullptr;
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  std::unique_ptr<ObjectActors> actors;
  std::unique_ptr<GhostActors> ghosts;
  ScenePlan plan;
  SceneFrame frame;
  Camera camera;
  SurfaceStyle style = SurfaceStyle::Glass;
  QTimer* resting = nullptr;
  bool placed = false;  // the camera has been put in place for a real size
  bool drawn = false;   // what is on the screen is `frame`
  std::int64_t pictures = 0;
  vtkSmartPointer<vtkCameraPass> plain = makePlainPass();
  vtkNew<vtkOpenGLFXAAPass> smooth;
  bool parallel = false;
  int coarse = 0, slow = 0;  // which of kQualities a movement is drawn in; slow pictures in a row
  QElapsedTimer sinceMoving;
  QPoint pressedAt, lastAt;
  Vec3 handAtPress;
  bool reaching = false;
  bool movable = false;  // start and target
  std::optional<TaskPlace> dragged;
  bool moved = false;  // since it was taken hold of: a click moves nothing
  QString placeWords;

  double width() const { return std::max(widget->width(), 1); }
  double height() const { return std::max(widget->height(), 1); }

  // The whole scene, with the pen as it stands at the start.
  void showWhole(const Vec3& direction) {
    std::vector<Vec3> points = plan.seen;
    for (const Vec3& hand : {plan.start, plan.target}) points.push_back(penEnd(hand, plan.handRadius));
    const double foot = plan.bareHand || !plan.forces.empty() ? std::min(SceneOverlay::kFootHeight, 0.12 * height()) : 0;
    camera = lookAtPointsBelow(overlay->headHeight() + foot, points, 0.06 * plan.size, direction, width(), height(), parallel);
    pan(camera, 0, -foot, height());
    applyCamera();
    render();
  }

  QPointF pixelOf(const Vec3& r) const {
    const auto [x, y] = scene::pixelOf(camera, r, width(), height());
    return {x, y};
  }

  const Vec3& at(TaskPlace place) const { return place == TaskPlace::Start ? plan.start : plan.target; }

  void applyCamera() {
    vtkCamera* c = renderer->GetActiveCamera();
    c->SetPosition(camera.position.x, camera.position.y, camera.position.z);
    c->SetFocalPoint(camera.focus.x, camera.focus.y, camera.focus.z);
    c->SetViewUp(camera.up.x, camera.up.y, camera.up.z);
    c->SetViewAngle(camera.angle);
    c->SetParallelProjection(camera.parallel);
    c->SetParallelScale(0.5 * metresPerPixel(camera, camera.focus, height()) * height());
    renderer->ResetCameraClippingRange();
    const CameraAxes axes = axesOf(camera);
    std::array<QPointF, 3> directions;
    const std::array<Vec3, 3> world{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (std::size_t i = 0; i < 3; ++i) directions[i] = {dot(world[i], axes.right), -dot(world[i], axes.up)};
    overlay->setView(directions, metresPerPixel(camera, plan.centre, height()));
    label();
  }

  // A tenth of a pixel is not seen: what rests costs nothing.
  bool showsAlready(const SceneFrame& next) const {
    return drawn &&
           !movedBeyond(0.1 * metresPerPixel(camera, plan.centre, height()) / std::max(1.0, widget->devicePixelRatioF()), frame, next);
  }

  std::optional<TaskPlace> placeAt(const QPoint& pixel) const {
    if (!movable || !plan.hasTask) return std::nullopt;
    std::optional<TaskPlace> nearest;
    double least = 0;
    for (const TaskPlace place : {TaskPlace::Target, TaskPlace::Start}) {
      const QPointF off = pixelOf(at(place)) - pixel;
      const double apart = std::hypot(off.x(), off.y()), grip = 1.5 * plan.markRadius / metresPerPixel(camera, at(place), height());
      if (apart > std::max(kGrip, grip) || (nearest && apart >= least)) continue;
      nearest = place;
      least = apart;
    }
    return nearest;
  }

  // Masses over one another look like one.
  void label() {
    if (!placeWords.isEmpty() && dragged) return overlay->setLabel(placeWords, pixelOf(at(*dragged)) + QPointF(0, kGrip));
    const int count = massesAtOnePlace(plan, frame);
    if (count == 0) return overlay->setLabel({}, {});
    const Vec3 at = frame.masses.back() + plan.massShift.back();
    const double radius = plan.massRadius.back() / metresPerPixel(camera, at, height());
    overlay->setLabel(QStringLiteral("%1 masses").arg(count), pixelOf(at) + QPointF(0, radius));
  }

  // A movement that the processor cannot follow is drawn coarser until it rests.
  void adapt() {
    const qint64 ms = sinceMoving.isValid() ? sinceMoving.restart() : (sinceMoving.start(), 0);
    if (ms > 4 * kRestMs) return;  // it was no movement before
    slow = ms > kSlowMs ? slow + 1 : 0;
    if (slow < kSlowPictures || coarse + 1 >= static_cast<int>(std::size(kQualities))) return;
    ++coarse;
    slow = 0;
  }

  // Where the processor draws, a movement that is too slow loses resolution first and smooth edges last.
  void render(bool moving = false) {
    drawn = false;
    if (!widget->isVisible()) return;
    const bool rough = moving && software != nullptr;
    const bool stereo = window->GetStereoRender() != 0;  // VTK's own pass alone moves the camera from eye to eye
    if (stereo) renderer->SetPass(nullptr);
    if (software != nullptr) {
      if (rough) adapt();
      const auto [scale, smoothed] = kQualities[rough ? coarse : 0];
      if (!stereo && smoothed) renderer->SetPass(smooth);
      if (!stereo && !smoothed) renderer->SetPass(plain);
      software->setScale(scale);
    }
    if (rough) resting->start();
    window->Render();
    drawn = true;
    ++pictures;
  }
};

SceneView::SceneView(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  impl_->window->SetMultiSamples(0);  // translucency needs it so; FXAA smooths the edges
  impl_->window->SetAlphaBitPlanes(1);
  if (scene::drawsInSoftware()) {
    impl_->widget = impl_->software = new SoftwareCanvas(*impl_->window, this);
  } else {
    auto* card = new QVTKOpenGLNativeWidget(this);
    card->setRenderWindow(impl_->window);
    impl_->widget = card;
    impl_->renderer->SetUseDepthPeeling(true);
    impl_->renderer->SetMaximumNumberOfPeels(6);
    impl_->renderer->SetOcclusionRatio(0);
  }
  layout->addWidget(impl_->widget);
  impl_->overlay = new SceneOverlay(this);
  impl_->window->AddRenderer(impl_->renderer);
  impl_->smooth->SetDelegatePass(impl_->plain);
  impl_->renderer->SetUseFXAA(true);
  impl_->renderer->GradientBackgroundOn();
  impl_->renderer->GetActiveCamera();
  addLights(*impl_->renderer);
  impl_->resting = new QTimer(this);
  impl_->resting->setSingleShot(true);
  impl_->resting->setInterval(kRestMs);
  connect(impl_->resting, &QTimer::timeout, this, &SceneView::renderNow);
  impl_->widget->installEventFilter(this);
  impl_->widget->setFocusPolicy(Qt::ClickFocus);  // a field beside the scene is left by a click into it
  setFocusPolicy(Qt::ClickFocus);
  setFocusProxy(impl_->widget);
  setMinimumSize(320, 198);
}

SceneView::~SceneView() = default;

void SceneView::setPlan(const ScenePlan& plan, bool resetView) {
  impl_->plan = plan;
  impl_->dragged.reset();
  impl_->ghosts.reset();
  impl_->actors.reset();
  impl_->actors = std::make_unique<ObjectActors>(*impl_->renderer, plan, impl_->style);
  const widgets::Colour &low = plan.look.colours.backgroundBottom, &high = plan.look.colours.backgroundTop;
  impl_->renderer->SetBackground(low.red, low.green, low.blue);
  impl_->renderer->SetBackground2(high.red, high.green, high.blue);
  impl_->coarse = impl_->slow = 0;
  impl_->frame = restingFrame(plan);
  impl_->actors->show(impl_->frame);
  impl_->label();
  if (resetView) resetCamera();
  else renderNow();
}

void SceneView::showFrame(const SceneFrame& frame) {
  if (!impl_->actors) return;
  if (impl_->showsAlready(frame)) return;
  impl_->frame = frame;
  impl_->actors->show(frame);
  impl_->label();
  impl_->render(true);
}

void SceneView::setGhosts(const std::vector<SceneFrame>& ghosts) {
  if (!impl_->ghosts && ghosts.empty()) return;
  if (!impl_->ghosts) impl_->ghosts = std::make_unique<GhostActors>(*impl_->renderer, impl_->plan);
  impl_->ghosts->show(ghosts);
  impl_->drawn = false;
}

void SceneView::setOverlay(const OverlayState& state) { impl_->overlay->setState(state); }

void SceneView::setOverlayVisible(bool visible) { impl_->overlay->setVisible(visible); }

void SceneView::setTextScale(double scale) { impl_->overlay->setTextScale(scale); }

void SceneView::setSurfaceStyle(SurfaceStyle style) {
  impl_->style = style;
  if (!impl_->actors) return;
  const SceneFrame kept = impl_->frame;
  setPlan(ScenePlan(impl_->plan), false);
  showFrame(kept);
}

void SceneView::resetCamera() { impl_->showWhole(impl_->plan.viewFrom); }

void SceneView::fit() { impl_->showWhole(impl_->camera.position - impl_->camera.focus); }

void SceneView::lookAlong(char axis) {
  impl_->showWhole(axis == 'x' ? Vec3{1, 0, 0} : axis == 'y' ? Vec3{0, 1, 0} : axis == 'z' ? Vec3{0, 0, 1} : impl_->plan.viewFrom);
}

void SceneView::renderNow() { impl_->render(); }

QImage SceneView::grabScene() {
  renderNow();
  return grab().toImage();
}

const Camera& SceneView::camera() const { return impl_->camera; }

void SceneView::setCamera(const Camera& camera) {
  impl_->camera = camera;
  impl_->placed = true;
  impl_->applyCamera();
  impl_->render(true);
}

void SceneView::setParallel(bool parallel) {
  impl_->parallel = parallel;
  fit();
}

void SceneView::setStereo(bool stereo) {
  impl_->window->SetStereoTypeToAnaglyph();
  impl_->window->SetStereoRender(stereo);
  impl_->coarse = impl_->slow = 0;  // it costs what two pictures do
  renderNow();
}

std::int64_t SceneView::picturesDrawn() const { return impl_->pictures; }

const ScenePlan& SceneView::plan() const { return impl_->plan; }
SceneFrame SceneView::frame() const { return impl_->frame; }

void SceneView::setPlacesMovable(bool movable) {
  if (impl_->movable == movable) return;
  impl_->movable = movable;
  impl_->widget->setMouseTracking(movable);
  impl_->widget->unsetCursor();
  if (!movable && impl_->dragged) Q_EMIT placeLeft(*std::exchange(impl_->dragged, {}));
}

void SceneView::showPlace(TaskPlace place, const Vec3& r, const QString& words) {
  Impl& d = *impl_;
  (place == TaskPlace::Start ? d.plan.start : d.plan.target) = r;
  d.placeWords = words;
  d.frame = restingFrame(d.plan);
  if (!d.actors) return;
  d.actors->movePlaces(d.plan.start, d.plan.target);
  d.actors->show(d.frame);
  d.label();
  d.render(true);
}

bool SceneView::drawsInSoftware() const { return impl_->software != nullptr; }

QPointF SceneView::pixelOf(const Vec3& world) const { return impl_->pixelOf(world); }

void SceneView::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  impl_->overlay->setGeometry(rect());
  impl_->overlay->raise();
  if (!impl_->placed) resetCamera();
  else impl_->applyCamera();
}

bool SceneView::eventFilter(QObject* watched, QEvent* event) {
  if (watched != impl_->widget) return QWidget::eventFilter(watched, event);
  Impl& d = *impl_;
  switch (event->type()) {
    case QEvent::MouseButtonPress: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      d.lastAt = d.pressedAt = mouse->pos();
      if (mouse->button() != Qt::LeftButton || mouse->modifiers().testFlag(Qt::ShiftModifier)) return true;
      d.dragged = d.placeAt(mouse->pos());
      d.moved = false;
      d.reaching = !d.dragged;
      d.handAtPress = ownHand(d.frame);
      if (d.dragged) d.widget->setCursor(Qt::ClosedHandCursor);
      return true;
    }
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const QPoint now = mouse->pos(), moved = now - d.lastAt;
      d.lastAt = now;
      if (d.dragged) {
        d.moved = d.moved || (now - d.pressedAt).manhattanLength() > kClick;
        if (d.moved && mouse->buttons().testFlag(Qt::LeftButton)) Q_EMIT placeDragged(*d.dragged, now);
        return true;
      }
      if (d.movable && mouse->buttons() == Qt::NoButton) {
        if (d.placeAt(now)) d.widget->setCursor(Qt::OpenHandCursor);
        else d.widget->unsetCursor();
      }
      if (d.reaching && mouse->buttons().testFlag(Qt::LeftButton)) {
        // Relative to where the hand was taken hold of, so that pressing beside it does not make it jump.
        const Vec3 from = pointUnder(d.camera, d.handAtPress, d.pressedAt.x(), d.pressedAt.y(), d.width(), d.height());
        const Vec3 to = pointUnder(d.camera, d.handAtPress, now.x(), now.y(), d.width(), d.height());
        const Vec3 hand = d.handAtPress + (to - from);
        Q_EMIT handDragged(hand.x, hand.y, hand.z, static_cast<qint64>(mouse->timestamp()));
        return true;
      }
      if (mouse->buttons() == Qt::NoButton) return true;
      const bool panning = mouse->buttons().testFlag(Qt::MiddleButton) || mouse->modifiers().testFlag(Qt::ShiftModifier);
      if (panning) pan(d.camera, moved.x(), moved.y(), d.height());
      else turn(d.camera, moved.x(), moved.y(), d.height());
      setCamera(d.camera);
      return true;
    }
    case QEvent::KeyPress:
      if (!d.dragged || static_cast<QKeyEvent*>(event)->key() != Qt::Key_Escape) return QWidget::eventFilter(watched, event);
      d.widget->unsetCursor();
      Q_EMIT placeLeft(*std::exchange(d.dragged, {}));
      return true;
    case QEvent::MouseButtonRelease:
      if (static_cast<QMouseEvent*>(event)->button() != Qt::LeftButton) return true;
      d.reaching = false;
      if (!d.dragged) return true;
      d.widget->unsetCursor();
      Q_EMIT placeDropped(*std::exchange(d.dragged, {}));
      return true;
    case QEvent::MouseButtonDblClick: return true;
    case QEvent::Wheel:
      zoom(d.camera, std::pow(1.0015, static_cast<QWheelEvent*>(event)->angleDelta().y()));
      setCamera(d.camera);
      return true;
    default: return QWidget::eventFilter(watched, event);
  }
}

}  // namespace reachlab::gui::scene
