// InspectorPage: the one trial that is looked at: its replay, its marks.
#include <QComboBox>
#include <QFileInfo>
#include <cmath>

#include "base/fault.h"
#include "base/system/error_report.h"
#include "gui/inspector/inspector.h"
#include "gui/inspector/marks_panel.h"
#include "gui/inspector/profile_plot.h"
#include "gui/inspector/replay_view.h"
#include "gui/inspector/analysis_lines.h"

namespace reachlab::gui::inspector {
namespace {

constexpr int kMostGhosts = 8;

}  // namespace

void InspectorPage::pick(int row) {
  if (row == picked_) return;
  picked_ = row;
  showPicked();
}

const analysis::Recording& InspectorPage::recordingOf(const std::string& path) {
  const auto known = recordings_.find(path);
  if (known != recordings_.end()) return known->second;
  if (recordings_.size() > 8) recordings_.clear();
  return recordings_.emplace(path, analysis::openRecording(path, scenes_)).first->second;
}

void InspectorPage::showPicked() {
  const auto line = lineOf(picked_);
  plot_->setPicked(line ? static_cast<int>(*line) : -1);
  if (!line) {
    plot_->setMarks({}, {});
    marks_->clear();
    return;
  }
  try {
    const auto conditionAt = [this](int at) { return table_->run(at).conditionOf(table_->trial(at)); };
    const auto trackOf = [&](std::size_t i) {
      const int row = inspectedRows_[i];
      return ReplayView::Track{TrialReplay(recordingOf(table_->run(row).path).run, table_->trial(row)), zeroOf(*inspection_, i)};
    };
    std::vector<ReplayView::Track> ghosts;
    for (std::size_t i = 0; i < inspectedRows_.size() && static_cast<int>(ghosts.size()) < kMostGhosts; ++i)
      if (i != *line && inspectedRows_[i] >= 0 && conditionAt(inspectedRows_[i]) == conditionAt(picked_)) ghosts.push_back(trackOf(i));
    const record::IndexedRun& run = table_->run(picked_);
    ReplayView::Track track = trackOf(*line);
    replay_->show(recordingOf(run.path).scenes.at(static_cast<std::size_t>(table_->trial(picked_).planned.scene)),
                  QFileInfo(QString::fromStdString(run.path)).path(), std::move(track), std::move(ghosts));
    const analysis::Movement& move = inspection_->signals[*line].movement;
    const double first = inspection_->input.trials[*line].first;
    const bool asMoved = axis_->currentIndex() == 0;
    plot_->setMarks(move.found && asMoved ? std::optional(0.0) : std::nullopt,
                    move.found && asMoved ? std::optional(move.duration()) : std::nullopt);
    marks_->show(tr("subject %1, session %2, run %3, trial %4")
                     .arg(QString::fromStdString(run.subject), QString::fromStdString(run.session))
                     .arg(run.run)
                     .arg(table_->trial(picked_).trial),
                 table_->mark(picked_), move.found ? first + move.onset : std::nan(""), move.found ? first + move.offset : std::nan(""));
  } catch (const std::exception& e) {
    replay_->clear();
    Q_EMIT said(QString::fromStdString(errorReportOf(e).sentence));
  }
}

void InspectorPage::marksDragged(double onset, double end, bool done) {
  const auto line = lineOf(picked_);
  if (!line || !done) return;
  const double zero = zeroOf(*inspection_, *line);
  const analysis::Movement& move = inspection_->signals[*line].movement;
  if (!(onset < end)) return showPicked();  // an onset behind the end is none
  try {
    record::TrialMark mark = table_->mark(picked_);
    if (std::abs(onset) > 1e-4) mark.onset = std::max(0.0, zero + onset);
    if (std::abs(end - move.duration()) > 1e-4) mark.offset = zero + end;
    setMark(mark);
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(errorReportOf(e).sentence));
  }
}

void InspectorPage::setMark(const record::TrialMark& mark) {
  if (picked_ < 0) return;
  if (analysis::isMotionFile(table_->run(picked_).path)) {  // a mark in the dataset would be no part of BIDS
    showPicked();
    Q_EMIT said(tr("Marks are kept beside a recording's log, and this dataset has no logs. Add the dataset's sourcedata to mark trials."));
    return;
  }
  try {
    const record::TrialMark before = table_->mark(picked_);
    table_->setMark(picked_, mark);
    if (mark.excluded != before.excluded || mark.onset != before.onset || mark.offset != before.offset) inspect();  // other numbers
    else showPicked();
  } catch (const std::exception& e) {
    Q_EMIT said(QString::fromStdString(errorReportOf(e).sentence));
  }
}

}  // namespace reachlab::gui::inspector
