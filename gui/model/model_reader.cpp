#include "gui/model/model_reader.h"

#include <QDir>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QMetaObject>
#include <cmath>
#include <exception>

#include "base/system/error_report.h"

namespace reachlab::gui::model {
namespace {

constexpr qint64 kLongMs = 300, kTellEveryMs = 100;  // what takes less tells no progress

/// Given up on the way; never leaves this file.
struct GivenUp {};

}  // namespace

std::string findSceneFile(const std::string& named, const QString& folder) {
  if (named.empty()) return named;
  const QString beside = QDir(folder).filePath(QString::fromStdString(named));
  return QFileInfo::exists(beside) ? beside.toStdString() : named;
}

ModelReader::ModelReader(QObject* parent) : QObject(parent) {}
ModelReader::~ModelReader() = default;

template <typename Tell>
void ModelReader::tell(int turn, Tell tell) {
  QMetaObject::invokeMethod(
      this,
      [this, turn, tell] {
        if (turn == turn_) tell();
      },
      Qt::QueuedConnection);
}

void ModelReader::begin(const std::string& file) {
  if (file == file_) return;
  file_ = file;
  model_.reset();
  thread_.request_stop();
  const int turn = ++turn_;
  Q_EMIT idle();
  if (file.empty()) return static_cast<void>(Q_EMIT ready());
  // The one before is waited for on the new thread, not on the window's.
  thread_ =
      std::jthread([this, turn, file, before = std::make_shared<std::jthread>(std::move(thread_))](const std::stop_token& stop) mutable {
        if (before->joinable()) before->join();
        before.reset();
        const QString what = tr("reading %1").arg(QFileInfo(QString::fromStdString(file)).fileName());
        QElapsedTimer clock;
        clock.start();
        qint64 toldAt = kLongMs - kTellEveryMs;
        const auto watch = [&](double share) {
          if (stop.stop_requested()) throw GivenUp{};
          if (clock.elapsed() < toldAt + kTellEveryMs) return;
          toldAt = clock.elapsed();
          const int percent = std::isfinite(share) ? static_cast<int>(100 * share) : -1;
          tell(turn, [this, what, percent] { Q_EMIT progressed(what, percent); });
        };
        std::shared_ptr<const Model> read;
        QString fault;
        try {
          read = std::make_shared<Model>(readModel(file, watch));
        } catch (const GivenUp&) {
        } catch (const std::exception& e) {
          fault = QString::fromStdString(errorReportOf(e).sentence);
        }
        tell(turn, [this, read, fault] {
          Q_EMIT idle();
          if (!fault.isEmpty()) return static_cast<void>(Q_EMIT failed(fault));
          if (!read) return;
          model_ = read;
          Q_EMIT ready();
        });
      });
}

void ModelReader::cancel() { thread_.request_stop(); }

}  // namespace reachlab::gui::model
