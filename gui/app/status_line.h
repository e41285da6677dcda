#pragma once

class QLabel;
class QStatusBar;

namespace reachlab::record {
struct RecordedTrial;
}
namespace reachlab::session {
class RecordedRun;
}

namespace reachlab::gui::app {

/// What the status bar tells of a run: rate, late ticks, the last trial's true time, method, the file that is written. The labels are the bar's.
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
