#include "gui/app/dataset_analysis.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QStandardPaths>
#include <utility>

#include "analysis/report/write_analysis.h"

namespace reachlab::gui::app {
namespace {

QString findReach() {
  const QString here = QCoreApplication::applicationDirPath();
  for (const char* place : {"/reach", "/../cli/reach"})
    if (QFileInfo(here + place).isExecutable()) return here + place;
  return QStandardPaths::findExecutable("reach");
}

QString reportOf(const QString& dataset) {
  return QString::fromStdString(analysis::analysisFolderOf(dataset.toStdString())) + "/report.html";
}

}  // namespace

DatasetAnalysis::DatasetAnalysis(QString program, QObject* parent)
    : QObject(parent), program_(program.isEmpty() ? findReach() : std::move(program)) {
  connect(&process_, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this,
          [this](int code, QProcess::ExitStatus status) { end(status == QProcess::NormalExit && code == 0); });
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) Q_EMIT said(tr("The analysis cannot start: %1: %2").arg(program_, process_.errorString()));
  });
}

DatasetAnalysis::~DatasetAnalysis() {
  process_.disconnect(this);
  process_.kill();  // what it has written so far is replaced by the next
  process_.waitForFinished();
}

void DatasetAnalysis::begin(const QString& dataset) {
  if (process_.state() != QProcess::NotRunning) {
    Q_EMIT said(tr("%1 is being analysed. Wait until it is done, then analyse the other dataset.").arg(dataset_));
    return;
  }
  if (program_.isEmpty()) {
    Q_EMIT said(tr("The analysis needs the program reach. Install the package reachlab-cli."));
    return;
  }
  dataset_ = dataset;
  Q_EMIT told(tr("%1 is being analysed.").arg(dataset_));
  process_.start(program_, {"analyze", dataset_});
}

void DatasetAnalysis::end(bool good) {
  if (good) {
    Q_EMIT told(tr("The report is in %1.").arg(reportOf(dataset_)));
    Q_EMIT reported(reportOf(dataset_));
    return;
  }
  // The last line is the reason; progress stands before it.
  const QString words = QString::fromUtf8(process_.readAllStandardError()).trimmed();
  Q_EMIT said(tr("The analysis of %1 failed: %2").arg(dataset_, words.section(QLatin1Char('\n'), -1).section(QLatin1Char('\r'), -1)));
}

}  // namespace reachlab::gui::app
