#pragma once
#include "sim/session/recorded_session.h"

class QLabel;
class QStatusBar;

namespace reachlab::gui::app {

/// Facts of a run in the status bar: rate, late ticks, the last trial's true time, method, and the log file. The status bar owns the
/// labels.
class StatusLine {
 public:
  explicit StatusLine(QStatusBar& bar);
  void runOpened(const session::RecordedRun& run);
  void runClosed();
  /// The loop's numbers as they are now.
  void refresh(session::RecordedRun& run);

 private:
  void showTrial(const record::RecordedTrial& trial);

  QLabel *rate_, *ticks_, *trial_, *method_, *recording_;
};

}  // namespace reachlab::gui::app
