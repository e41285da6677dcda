#include "gui/model/name_in_file.h"

#include <QDir>
#include <QFileInfo>

namespace reachlab::gui::model {

std::string nameInFile(const std::string& named, const QString& file) {
  const QFileInfo asked(QString::fromStdString(named));
  if (!asked.isFile()) return named;
  const QString beside = QFileInfo(file).absoluteDir().relativeFilePath(asked.absoluteFilePath());
  return (beside.startsWith(QLatin1String("../")) ? asked.absoluteFilePath() : beside).toStdString();
}

}  // namespace reachlab::gui::model
