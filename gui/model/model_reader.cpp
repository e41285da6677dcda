#include "gui/model/model_reader.h"

#include <QDir>
#include <QElapsedTimer>
#include <QFileInfo>
#include <cmath>

namespace reachlab::gui::model {
namespace {

constexpr qint64 kLongMs = 300, kTellEveryMs = 100;  // what takes less tells no progress

}  // namespace

std::string findSceneFile(const std::string& named, const QString& folder) {
  if (named.empty()) return named;
  const QString beside = QDir(folder).filePath(QString::fromStdString(named));
  return QFileInfo::exists(beside) ? beside.toStdString() : named;
}

void ModelReader::begin(const std::string& file) {
  if (file == file_) return;
  file_ = file;
  model_.reset();
  work_.drop();
  Q_EMIT idle();
  if (file.empty()) return static_cast<void>(Q_EMIT ready());
  const auto read = std::make_shared<std::shared_ptr<const Model>>();
  work_.begin(
      [this, file, read](const widgets::NewestWork::Turn& turn) {
        const QString what = tr("reading %1").arg(QFileInfo(QString::fromStdString(file)).fileName());
        QElapsedTimer clock;
        clock.start();
        qint64 toldAt = kLongMs - kTellEveryMs;
        *read = std::make_shared<Model>(readModel(file, [&](double share) {
          turn.goOn();
          if (clock.elapsed() < toldAt + kTellEveryMs) return;
          toldAt = clock.elapsed();
          const int percent = std::isfinite(share) ? static_cast<int>(100 * share) : -1;
          turn.tell([this, what, percent] { Q_EMIT progressed(what, percent); });
        }));
      },
      [this, read](const QString& fault) {
        Q_EMIT idle();
        if (!fault.isEmpty()) return static_cast<void>(Q_EMIT failed(fault));
        if (!*read) return;
        model_ = *read;
        Q_EMIT ready();
      });
}

}  // namespace reachlab::gui::model
