#include "gui/app/status_line.h"

#include <QStatusBar>
#include <cmath>

#include "gui/widgets/named.h"

namespace reachlab::gui::app {

StatusLine::StatusLine(QStatusBar& bar)
    : rate_(new QLabel),
      ticks_(widgets::tipped(widgets::named<QLabel>("ticks"),
                             "Servo cycles of 1 ms in this run.\nlate: cycles that began later than their time, but were computed.\n"
                             "missed: cycles that were left out, because the computer was busy.\n"
                             "clamped: cycles in which the force was limited to the maximum of the device.\n"
                             "not recorded: cycles that the disk was too slow for.")),
      trial_(widgets::tipped(
          widgets::named<QLabel>("trialTime"),
          "The last trial from its go signal to its end, by the computer's clock; ticks of 1 ms that it missed, and that were not "
          "recorded")),
      method_(new QLabel),
      recording_(widgets::tipped(widgets::named<QLabel>("recording"), "The log of the run that is open or was open last")) {
  recording_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  for (QLabel* label : {rate_, ticks_, trial_, method_}) bar.addWidget(label);
  bar.addPermanentWidget(recording_);
  runClosed();
}

void StatusLine::runOpened(const session::RecordedRun& run) {
  const dynamics::MethodChoice& choice = run.choice();
  method_->setText(QStringLiteral("%1 (%2)").arg(QString::fromStdString(choice.method), QString::fromStdString(choice.form)));
  QString why = QString::fromStdString(choice.reason);
  for (const std::string& warning : choice.warnings) why += QLatin1Char('\n') + QString::fromStdString(warning);
  method_->setToolTip(why);
  recording_->setText(QString::fromStdString(run.logPath()));
}

void StatusLine::runClosed() { rate_->setText("no run is open"); }

void StatusLine::refresh(session::RecordedRun& run) {
  const haptics::LoopReport report = run.report();
  const haptics::TickState& s = run.latest();
  rate_->setText(QStringLiteral("%1 Hz").arg(report.rate, 0, 'f', 1));
  rate_->setToolTip(QStringLiteral("%1; lateness p50 %2 µs, p99 %3 µs, max %4 µs")
                        .arg(QString::fromStdString(report.mode))
                        .arg(report.latenessP50, 0, 'f', 0)
                        .arg(report.latenessP99, 0, 'f', 0)
                        .arg(report.latenessMax, 0, 'f', 0) +
                    (run.timingVerdict() ? QLatin1Char('\n') + QString::fromStdString(run.timingVerdict()->sentence) : QString()));
  ticks_->setText(QStringLiteral("late %1  missed %2  clamped %3%4")
                      .arg(s.faults.lateTicks)
                      .arg(s.faults.missedTicks)
                      .arg(s.faults.clampedTicks)
                      .arg(s.faults.droppedRecords > 0 ? QStringLiteral("  not recorded %1").arg(s.faults.droppedRecords) : QString()));
  showTrial(run.lastTrial());
}

// By the computer's clock: longer than the ticks say where some were missed.
void StatusLine::showTrial(const record::RecordedTrial& trial) {
  if (trial.trial == 0 || !std::isfinite(trial.elapsed)) return trial_->clear();
  QString text = QStringLiteral("trial %1: %2 s").arg(trial.trial).arg(trial.elapsed, 0, 'f', 3);
  if (trial.missedTicks > 0) text += QStringLiteral(", missed %1").arg(trial.missedTicks);
  if (trial.droppedTicks > 0) text += QStringLiteral(", not recorded %1").arg(trial.droppedTicks);
  trial_->setText(text);
}

}  // namespace reachlab::gui::app
