#pragma once
#include <QImage>
#include <QObject>
#include <QString>
#include <QThreadPool>
#include <atomic>

#include "gui/scene/scene_view.h"

class QTimer;

namespace reachlab::gui::app {

/// Writes pictures of a scene for a film, 25 per second, as frame-000001.png and so on. A separate thread writes them. If the disk is too
/// slow, pictures are left out and counted, so that neither window nor memory suffers. All pictures have the size of the first picture,
/// made even, as encoders need it. A later picture of a different size is fitted into it.
class FrameRecorder : public QObject {
  Q_OBJECT
 public:
  static constexpr int kPerSecond = 25;
  FrameRecorder(scene::SceneView& view, QObject* parent);

  void start(const QString& folder);
  /// `ended` follows when the last picture is written.
  void stop();

 Q_SIGNALS:
  void progressed(int written, int leftOut);
  void ended(const QString& sentence);

 private:
  void take();
  void write(const QImage& picture);  // on the pool's thread

  scene::SceneView& view_;
  QTimer* timer_;
  QString folder_;
  QSize size_;  // of the film, from its first picture on [pixel]
  int leftOut_ = 0;
  std::atomic<int> waiting_{0}, written_{0}, failed_{0};
  QThreadPool pool_;  // of one thread, which writes in the order of the film; last: it ends before what it uses
};

}  // namespace reachlab::gui::app
