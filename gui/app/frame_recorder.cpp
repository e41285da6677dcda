#include "gui/app/frame_recorder.h"

#include <QPainter>
#include <QTimer>

namespace reachlab::gui::app {
namespace {

constexpr int kMostWaiting = 20;

QImage fitted(const QImage& picture, const QSize& size) {
  if (QSize(picture.width() / 2 * 2, picture.height() / 2 * 2) == size) return picture.copy(QRect(QPoint(), size));
  QImage whole(size, QImage::Format_RGB32);
  whole.fill(Qt::black);
  const QImage inside = picture.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation);
  QPainter(&whole).drawImage((size.width() - inside.width()) / 2, (size.height() - inside.height()) / 2, inside);
  return whole;
}

}  // namespace

FrameRecorder::FrameRecorder(scene::SceneView& view, QObject* parent) : QObject(parent), view_(view), timer_(new QTimer(this)) {
  timer_->setInterval(1000 / kPerSecond);
  timer_->setTimerType(Qt::PreciseTimer);
  connect(timer_, &QTimer::timeout, this, &FrameRecorder::take);
  pool_.setMaxThreadCount(1);
}

void FrameRecorder::start(const QString& folder) {
  if (timer_->isActive()) return;
  pool_.waitForDone();  // of the film before
  folder_ = folder;
  written_ = leftOut_ = failed_ = 0;
  size_ = {};
  timer_->start();
}

void FrameRecorder::stop() {
  if (!timer_->isActive()) return;
  timer_->stop();
  pool_.start([this] {
    QString sentence = tr("%1 pictures, %2 per second, are in %3").arg(written_).arg(kPerSecond).arg(folder_);
    if (leftOut_ > 0) sentence += tr("; %1 left out: the disk was too slow").arg(leftOut_);
    if (failed_ > 0) sentence += tr("; %1 could not be written").arg(failed_);
    QMetaObject::invokeMethod(
        this, [this, sentence] { Q_EMIT ended(sentence); }, Qt::QueuedConnection);
  });
}

void FrameRecorder::take() {
  const QImage picture = view_.grabScene();
  if (size_.isEmpty()) size_ = {picture.width() / 2 * 2, picture.height() / 2 * 2};
  if (waiting_ < kMostWaiting) {
    ++waiting_;
    pool_.start([this, fit = fitted(picture, size_)] { write(fit); });
  } else {
    ++leftOut_;
  }
  Q_EMIT progressed(written_, leftOut_);
}

void FrameRecorder::write(const QImage& picture) {
  const QString file = QStringLiteral("%1/frame-%2.png").arg(folder_).arg(written_ + 1, 6, 10, QLatin1Char('0'));
  ++(picture.save(file, "PNG", 80) ? written_ : failed_);
  --waiting_;
}

}  // namespace reachlab::gui::app
