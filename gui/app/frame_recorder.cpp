#include "gui/app/frame_recorder.h"

#include <QMetaObject>
#include <QPainter>
#include <QTimer>

#include "gui/scene/scene_view.h"

namespace reachlab::gui::app {
namespace {

constexpr std::size_t kMostWaiting = 20;

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
}

FrameRecorder::~FrameRecorder() = default;

void FrameRecorder::start(const QString& folder) {
  if (timer_->isActive()) return;
  thread_ = {};  // of the film before: done
  folder_ = folder;
  written_ = leftOut_ = failed_ = 0;
  last_ = false;
  waiting_.clear();
  size_ = {};
  thread_ = std::jthread([this](const std::stop_token& stop) { write(stop); });
  timer_->start();
}

void FrameRecorder::stop() {
  if (!timer_->isActive()) return;
  timer_->stop();
  const std::scoped_lock lock(mutex_);
  last_ = true;
  changed_.notify_all();
}

void FrameRecorder::take() {
  QImage picture = view_.grabScene();
  if (size_.isEmpty()) size_ = {picture.width() / 2 * 2, picture.height() / 2 * 2};
  picture = fitted(picture, size_);
  std::unique_lock lock(mutex_);
  const bool room = waiting_.size() < kMostWaiting;
  if (room) waiting_.push_back(std::move(picture));
  else ++leftOut_;
  changed_.notify_all();
  const int written = written_, leftOut = leftOut_;
  lock.unlock();
  Q_EMIT progressed(written, leftOut);
}

void FrameRecorder::write(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return last_ || !waiting_.empty(); })) {
    if (waiting_.empty()) break;
    const QImage picture = std::move(waiting_.front());
    waiting_.pop_front();
    const QString file = QStringLiteral("%1/frame-%2.png").arg(folder_).arg(written_ + 1, 6, 10, QLatin1Char('0'));
    lock.unlock();
    const bool good = picture.save(file, "PNG", 80);
    lock.lock();
    ++(good ? written_ : failed_);
  }
  QString sentence = tr("%1 pictures, %2 per second, are in %3").arg(written_).arg(kPerSecond).arg(folder_);
  if (leftOut_ > 0) sentence += tr("; %1 left out: the disk was too slow").arg(leftOut_);
  if (failed_ > 0) sentence += tr("; %1 could not be written").arg(failed_);
  QMetaObject::invokeMethod(
      this, [this, sentence] { Q_EMIT ended(sentence); }, Qt::QueuedConnection);
}

}  // namespace reachlab::gui::app
