#include "gui/scene/software_canvas.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPainter>
#include <cmath>
#include <vtkCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

namespace reachlab::gui::scene {

const QString& rendererName() {
  static const QString name = [] {
    QOffscreenSurface surface;
    surface.create();
    QOpenGLContext context;
    if (!context.create() || !context.makeCurrent(&surface)) return QStringLiteral("unknown");
    return QString::fromUtf8(reinterpret_cast<const char*>(context.functions()->glGetString(GL_RENDERER)));
  }();
  return name;
}

bool drawsInSoftware() { return rendererName().contains(QLatin1String("llvmpipe")) || rendererName().contains(QLatin1String("softpipe")); }

SoftwareCanvas::SoftwareCanvas(vtkGenericOpenGLRenderWindow& window, QWidget* parent)
    : QWidget(parent), window_(&window), surface_(std::make_unique<QOffscreenSurface>()), context_(std::make_unique<QOpenGLContext>()) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  surface_->create();
  context_->create();
  observers_ = {window.AddObserver(vtkCommand::WindowMakeCurrentEvent, this, &SoftwareCanvas::makeCurrent),
                window.AddObserver(vtkCommand::WindowIsCurrentEvent, this, &SoftwareCanvas::tellCurrent),
                window.AddObserver(vtkCommand::WindowFrameEvent, this, &SoftwareCanvas::keepPicture)};
  window.SetForceMaximumHardwareLineWidth(1);
  window.SetOwnContext(0);
  makeCurrent();
  window.OpenGLInitContext();
  invertsRows_ = context_->hasExtension("GL_MESA_pack_invert");
}

SoftwareCanvas::~SoftwareCanvas() {
  makeCurrent();
  window_->Finalize();
  window_->SetReadyForRendering(false);
  for (const unsigned long observer : observers_) window_->RemoveObserver(observer);
}

void SoftwareCanvas::makeCurrent() { context_->makeCurrent(surface_.get()); }

void SoftwareCanvas::tellCurrent(vtkObject*, unsigned long, void* answer) {
  *static_cast<bool*>(answer) = QOpenGLContext::currentContext() == context_.get();
}

void SoftwareCanvas::setScale(double scale) {
  scale_ = scale;
  fit();
}

// Whether the picture's size was another.
bool SoftwareCanvas::fit() {
  const double pixels = scale_ * devicePixelRatioF();
  const int w = std::max(1, static_cast<int>(std::lround(width() * pixels))),
            h = std::max(1, static_cast<int>(std::lround(height() * pixels)));
  const int* now = window_->GetSize();
  if (now[0] == w && now[1] == h) return false;
  window_->SetSize(w, h);
  return true;
}

void SoftwareCanvas::keepPicture() {
  vtkOpenGLFramebufferObject* drawn = window_->GetDisplayFramebuffer();
  const int* size = drawn->GetLastSize();
  // The bytes of a screen's pixel, in memory that is there already: as many conversions and copies less.
  if (picture_.width() != size[0] || picture_.height() != size[1]) picture_ = QImage(size[0], size[1], QImage::Format_RGB32);
  window_->GetState()->PushReadFramebufferBinding();
  drawn->Bind(GL_READ_FRAMEBUFFER);
  drawn->ActivateReadBuffer(0);
  QOpenGLFunctions& gl = *context_->functions();
  constexpr GLenum kPackInvert = 0x8758;  // GL_PACK_INVERT_MESA
  if (invertsRows_) gl.glPixelStorei(kPackInvert, GL_TRUE);
  gl.glReadPixels(0, 0, size[0], size[1], GL_BGRA, GL_UNSIGNED_BYTE, picture_.bits());
  if (invertsRows_) gl.glPixelStorei(kPackInvert, GL_FALSE);
  window_->GetState()->PopReadFramebufferBinding();
  if (!invertsRows_) picture_ = std::move(picture_).mirrored();  // OpenGL's first row is the lowest
  update();
}

void SoftwareCanvas::paintEvent(QPaintEvent*) {
  if (fit() || picture_.isNull()) window_->Render();
  QPainter painter(this);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(rect(), picture_);
}

}  // namespace reachlab::gui::scene
