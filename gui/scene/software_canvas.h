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

/// Shows what VTK draws where the processor draws it: into memory, which is then painted as any widget is. A QOpenGLWidget would have the
/// processor put the whole top-level window together as textures for each picture, which costs twice what the scene does.
class SoftwareCanvas : public QWidget {
 public:
  SoftwareCanvas(vtkGenericOpenGLRenderWindow& window, QWidget* parent);
  ~SoftwareCanvas() override;

  /// Pixels drawn for one of the screen's, along either side. From the next picture on.
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
  double scale_ = 1;
};

}  // namespace reachlab::gui::scene
