// InspectorPage: a dataset is opened beside the window, with progress.
#include <QFileInfo>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStandardPaths>
#include <QTableView>
#include <QTimer>

#include "base/system/error_report.h"
#include "gui/inspector/inspector.h"
#include "gui/inspector/marks_panel.h"
#include "gui/inspector/replay_view.h"

namespace reachlab::gui::inspector {
namespace {

QString indexFolder() { return QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation) + QStringLiteral("/reachlab"); }

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
    return record::openTrialIndex(path, record::indexFileFor(path, folder), [&](std::size_t now, std::size_t all) {
      *done = static_cast<int>(now);
      *of = static_cast<int>(all);
      return !*stop;
    });
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
  logs_.clear();
  experiments_.clear();
  inspection_.reset();
  inspectedRows_.clear();
  picked_ = -1;
  QStringList unread;
  for (const std::string& sentence : index.unreadable) unread << QString::fromStdString(sentence);
  table_->setIndex(std::move(index));
  if (!unread.isEmpty()) Q_EMIT said(unread.join(QLatin1Char('\n')));
  title_->setText(QFileInfo(path_).fileName().isEmpty() ? path_ : QFileInfo(path_).fileName());
  title_->setToolTip(path_);
  count_->setText(tr("%1 trials, %2 runs").arg(table_->rowCount()).arg(table_->recordings().runs.size()));
  const int widths[] = {58, 58, 124, 36, 42, 126, 54, 78, 66, 66, 80};
  for (int column = 0; column < TrialTable::kColumns; ++column) view_->setColumnWidth(column, widths[column]);
  report_->setEnabled(table_->rowCount() > 0);
  marks_->clear();
  replay_->clear();
  draw();
  if (filter_->rowCount() > 0) view_->selectRow(0);
}

}  // namespace reachlab::gui::inspector
