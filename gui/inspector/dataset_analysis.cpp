#include "gui/inspector/dataset_analysis.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStandardPaths>
#include <utility>

#include "analysis/report/write_analysis.h"

namespace reachlab::gui::inspector {
namespace {

QString findReach() {
  const QString here = QCoreApplication::applicationDirPath();
  for (const char* place : {"/reach", "/../cli/reach"})
    if (QFileInfo(here + place).isExecutable()) return here + place;
  return QStandardPaths::findExecutable("reach");
}

QString reportOf(const QString& dataset) {
  const std::string folder = analysis::analysisFolderOf(dataset.toStdString());
  return QFileInfo(QString::fromStdString(folder) + "/report.html").absoluteFilePath();  // a browser knows no folder of ours
}

}  // namespace

DatasetAnalysis::DatasetAnalysis(QString program, QObject* parent)
    : QObject(parent), program_(program.isEmpty() ? findReach() : std::move(program)) {
  connect(&process_, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this,
          [this](int code, QProcess::ExitStatus status) { end(status == QProcess::NormalExit && code == 0); });
  connect(&process_, &QProcess::readyReadStandardError, this, &DatasetAnalysis::readProgress);
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error != QProcess::FailedToStart) return;
    Q_EMIT said(tr("The analysis cannot start: %1: %2").arg(program_, process_.errorString()));
    Q_EMIT idle();
  });
}

DatasetAnalysis::~DatasetAnalysis() {
  process_.disconnect(this);
  process_.kill();  // what it has written so far is replaced by the next
  process_.waitForFinished();
}

void DatasetAnalysis::begin(const QString& dataset) {
  if (busy()) return Q_EMIT said(tr("%1 is being analysed. Wait until it is done, then analyse the other dataset.").arg(dataset_));
  if (program_.isEmpty()) return Q_EMIT said(tr("The analysis needs the program reach. Install the package reachlab-cli."));
  dataset_ = dataset;
  words_.clear();
  cancelled_ = false;
  Q_EMIT told(tr("%1 is being analysed.").arg(dataset_));
  Q_EMIT progressed(tr("analysing"), 0, 0);
  process_.start(program_, {"analyze", dataset_, "--progress"});
}

void DatasetAnalysis::cancel() {
  cancelled_ = busy();
  process_.kill();
}

// Each line says what is done, how much of it, and of how much.
void DatasetAnalysis::readProgress() {
  static const QRegularExpression kLine("^(.+) (\\d+) of (\\d+)$");
  words_ += QString::fromUtf8(process_.readAllStandardError());
  const auto line = kLine.match(words_.trimmed().section(QLatin1Char('\n'), -1));
  if (line.hasMatch()) Q_EMIT progressed(line.captured(1), line.captured(2).toInt(), line.captured(3).toInt());
}

void DatasetAnalysis::end(bool good) {
  readProgress();
  if (cancelled_) {
    Q_EMIT told(tr("The analysis of %1 is cancelled.").arg(dataset_));
  } else if (good) {
    Q_EMIT told(tr("The report is in %1.").arg(reportOf(dataset_)));
    Q_EMIT reported(reportOf(dataset_));
  } else {  // the last line is the reason
    Q_EMIT said(tr("The analysis of %1 failed: %2").arg(dataset_, words_.trimmed().section(QLatin1Char('\n'), -1)));
  }
  Q_EMIT idle();
}

}  // namespace reachlab::gui::inspector
