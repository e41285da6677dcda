#pragma once
#include <QImage>
#include <QObject>
#include <QString>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

class QTimer;

namespace reachlab::gui::scene {
class SceneView;
}

namespace reachlab::gui::app {

/// Writes pictures of a scene for a film, 25 per second, as frame-000001.png and so on. A separate thread writes them. If the disk is too
/// slow, pictures are left out and counted, so that neither window nor memory suffers. All pictures have the size of the first picture,
/// made even, as encoders need it. A later picture of a different size is fitted into it.
class FrameRecorder : public QObject {
  Q_OBJECT
 public:
  static constexpr int kPerSecond = 25;
  FrameRecorder(scene::SceneView& view, QObject* parent);
  ~FrameRecorder() override;

  void start(const QString& folder);
  /// `ended` follows when the last picture is written.
  void stop();

 Q_SIGNALS:
  void progressed(int written, int leftOut);
  void ended(const QString& sentence);

 private:
  void take();
  void write(const std::stop_token& stop);

  scene::SceneView& view_;
  QTimer* timer_;
  QString folder_;
  QSize size_;        // of the film, from its first picture on [pixel]
  std::mutex mutex_;  // guards what follows
  std::condition_variable_any changed_;
  std::deque<QImage> waiting_;
  int written_ = 0, leftOut_ = 0, failed_ = 0;
  bool last_ = false;
  std::jthread thread_;
};

}  // namespace reachlab::gui::app
