#pragma once
#include <QImage>
#include <QWidget>
#include <array>
#include <memory>
#include <vtkSmartPointer.h>

class QOffscreenSurface;
class QOpenGLContext;
class vtkGenericOpenGLRenderWindow;
class vtkObject;

namespace reachlab::gui::scene {

/// The name that the OpenGL renderer gives itself: "llvmpipe (LLVM 15.0.6, 256 bits)". Asked once, in the window's thread.
const QString& rendererName();
/// Whether the processor draws.
bool drawsInSoftware();

/// Shows the pictures of VTK if the processor draws them. They are drawn into memory and painted like any widget. With a QOpenGLWidget, the
/// processor would compose the whole top-level window from textures, which costs twice as much as the scene.
class SoftwareCanvas : public QWidget {
 public:
  SoftwareCanvas(vtkGenericOpenGLRenderWindow& window, QWidget* parent);
  ~SoftwareCanvas() override;

  /// Drawn pixels per screen pixel, along either side. Takes effect with the next picture.
  void setScale(double scale);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void makeCurrent();
  void tellCurrent(vtkObject*, unsigned long, void* answer);
  void keepPicture();
  bool fit();

  vtkSmartPointer<vtkGenericOpenGLRenderWindow> window_;
  std::array<unsigned long, 3> observers_{};
  std::unique_ptr<QOffscreenSurface> surface_;
  std::unique_ptr<QOpenGLContext> context_;
  QImage picture_;
  bool invertsRows_ = false;
  double scale_ = 1;
};

}  // namespace reachlab::gui::scene
