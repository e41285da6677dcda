#include "gui/scene/renderer_name.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>

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

}  // namespace reachlab::gui::scene
