// InspectorPage: a dataset is opened beside the window, with progress.
#include <QFileInfo>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStandardPaths>
#include <QTableView>
#include <QTimer>

#include "base/fault.h"
#include "base/system/error_report.h"
#include "gui/inspector/inspector.h"
#include "gui/inspector/marks_panel.h"
#include "gui/inspector/replay_view.h"

namespace reachlab::gui::inspector {
namespace {

QString indexFolder() { return QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + QStringLiteral("/reachlab"); }

// A folder without logs may hold what was exported from them.
bool hasLogs(const std::string& path) {
  try {
    return !record::findLogs(path).empty();
  } catch (const FaultError&) {
    return !QFileInfo(QString::fromStdString(path)).isDir();
  }
}

}  // namespace

void InspectorPage::open(const QString& path) {
  inspector_.cancel();
  if (openingStop_) *openingStop_ = true;
  path_ = path;
  Q_EMIT said({});
  openingDone_ = std::make_shared<std::atomic<int>>(0);
  openingOf_ = std::make_shared<std::atomic<int>>(0);
  openingStop_ = std::make_shared<std::atomic<bool>>(false);
  opening_ = std::async(std::launch::async, [path = path.toStdString(), folder = indexFolder().toStdString(), done = openingDone_,
                                             of = openingOf_, stop = openingStop_] {
    const record::IndexProgress progress = [&](std::size_t now, std::size_t all) {
      *done = static_cast<int>(now);
      *of = static_cast<int>(all);
      return !*stop;
    };
    return hasLogs(path) ? record::openTrialIndex(path, record::indexFileFor(path, folder), progress)
                         : analysis::indexMotionFiles(path, progress);
  });
  opener_->start();
  pollOpening();
}

void InspectorPage::pollOpening() {
  if (!opening_.valid()) return opener_->stop();
  if (opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    progress_->setRange(0, *openingOf_);
    progress_->setValue(*openingDone_);
    progress_->setFormat(tr("indexing %v / %m"));
    progress_->setVisible(*openingOf_ > 0);
    cancel_->setVisible(*openingOf_ > 0);
    return;
  }
  opener_->stop();
  progress_->hide();
  cancel_->hide();
  try {
    opened(opening_.get());
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(errorReportOf(e).sentence));
  }
}

void InspectorPage::opened(record::TrialIndex index) {
  recordings_.clear();
  scenes_ = {};
  inspection_.reset();
  inspectedRows_.clear();
  picked_ = -1;
  QStringList sentences, losses;
  for (const std::string& sentence : index.unreadable) sentences << QString::fromStdString(sentence);
  for (const record::IndexedRun& run : index.runs)
    if (!run.loss.empty()) losses << QString::fromStdString(run.loss);
  sentences << losses;
  const bool exported = !index.runs.empty() && analysis::isMotionFile(index.runs.front().path);
  if (exported) Q_EMIT told(tr("This dataset has no logs. Its Motion-BIDS files are shown, without marks and notes."));
  table_->setIndex(std::move(index));
  if (!sentences.isEmpty()) Q_EMIT said(sentences.join(QLatin1Char('\n')));
  title_->setText(QFileInfo(path_).fileName().isEmpty() ? path_ : QFileInfo(path_).fileName());
  title_->setToolTip(path_);
  QString count = tr("%1 trials, %2 runs").arg(table_->rowCount()).arg(table_->recordings().runs.size());
  if (!losses.isEmpty()) count += tr(", %1 with losses").arg(losses.size());
  count_->setText(count);
  count_->setToolTip(losses.join(QLatin1Char('\n')));
  fitColumns();
  report_->setEnabled(table_->rowCount() > 0);
  marks_->clear();
  replay_->clear();
  draw();
  if (filter_->rowCount() > 0) view_->selectRow(0);
}

}  // namespace reachlab::gui::inspector
