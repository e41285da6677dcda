#pragma once

class QLabel;
class QStatusBar;

namespace reachlab::session {
class RecordedRun;
}

namespace reachlab::gui::app {

/// What the status bar tells of a run: rate, late ticks, method, the file that is written. The labels are the bar's.
class StatusLine {
 public:
  explicit StatusLine(QStatusBar& bar);
  void runOpened(const session::RecordedRun& run);
  void runClosed();
  /// The loop's numbers as they are now.
  void refresh(session::RecordedRun& run);

 private:
  QLabel *rate_, *ticks_, *method_, *recording_;
};

}  // namespace reachlab::gui::app
