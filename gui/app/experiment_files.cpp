#include "gui/app/experiment_files.h"

#include <QFileInfo>
#include <QSaveFile>
#include <QSettings>
#include <algorithm>

#include "base/error.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/file_text.h"
#include "sim/experiment/resources.h"

namespace reachlab::gui::app {
namespace {

constexpr int kMostRecent = 8;

QString recentKey() { return "recentFiles"; }

}  // namespace

void writeExperiment(const experiment::Experiment& experiment, const QString& file) {
  QSaveFile out(file);
  const std::string text = experiment::fileText(experiment);
  if (!out.open(QIODevice::WriteOnly) || out.write(text.data(), static_cast<qint64>(text.size())) < 0 || !out.commit())
    throw ResourceError(file.toStdString() + ": could not be written: " + out.errorString().toStdString());
}

bool isRecorded(const QString& file) {
  const QFileInfo info(file);
  return info.isDir() || (info.isFile() && info.suffix() == QLatin1String("reach"));
}

QStringList recentFiles() {
  QStringList files = QSettings().value(recentKey()).toStringList();
  files.erase(std::remove_if(files.begin(), files.end(), [](const QString& file) { return !QFileInfo::exists(file); }), files.end());
  return files;
}

void rememberFile(const QString& file) {
  const QString path = QFileInfo(file).absoluteFilePath();
  QStringList files = recentFiles();
  files.removeAll(path);
  files.prepend(path);
  while (files.size() > kMostRecent) files.removeLast();
  QSettings().setValue(recentKey(), files);
}

experiment::CompiledExperiment newExperiment(const Template& from) {
  experiment::Experiment experiment = experiment::openExperiment(from.shipped).experiment();
  experiment.name = "untitled";
  experiment.text = toJson(experiment);
  return experiment::CompiledExperiment(experiment);
}

QString manualPage() {
  const QString resources = QString::fromStdString(experiment::resourceFolder());
  for (const char* page : {"/../doc/reachlab/html/index.html", "/../build/manual/index.html", "/../docs/index.md"})
    if (const QFileInfo file(resources + QLatin1String(page)); file.exists()) return file.canonicalFilePath();
  return {};
}

}  // namespace reachlab::gui::app
