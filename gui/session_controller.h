#pragma once
#include <QObject>
#include <QStringList>
#include <memory>
#include <optional>
#include <vector>

#include "gui/window_run.h"

namespace reachlab::gui {

/// The session behind the window: the experiment as edited, the blocks still to be done, and the run that is open. Knows no widget.
/// Changes take effect between trials: a run that is open is then ended, and the next trial opens a new one with the new settings, so
/// that each log holds one configuration.
class SessionController : public QObject {
  Q_OBJECT
 public:
  /// Reads the experiment, or the plan and its first block. Throws UsageError.
  explicit SessionController(const session::SessionRequest& request, QObject* parent = nullptr);
  ~SessionController() override;

  const experiment::Experiment& experiment() const { return experiment_; }
  const constraints::Constraint& constraint() const { return constraint_; }
  /// A plan has its settings in its file: they are shown, not edited.
  bool isPlan() const { return isPlan_; }
  /// Every fault of an edited experiment; it is taken over when there is none.
  QStringList tryEdit(const experiment::Experiment& experiment);

  /// Puts the next trial up; opens a run first if none is open. False when nothing is left of a plan. Throws children of Error.
  bool next(const session::SessionRequest& request);
  void abort();
  /// The last trial once more, at the end of the run. False when there was none.
  bool repeat();
  void note(const QString& text);
  void endRun();
  void pointTo(double x, double y, double z);
  /// Looks at the newest state. From the frame timer.
  void poll();

  WindowRun* run() { return run_.get(); }  // null: none is open
  bool underWay() const { return run_ && run_->underWay(); }
  std::optional<haptics::ConductedTrial> lastTrial() const { return last_; }

 Q_SIGNALS:
  void experimentChanged();
  void runOpened();
  void runClosed();
  void trialBegun();
  void trialEnded();
  /// One sentence for the experimenter: the disk, the device, the computation. Finished trials are safe.
  void failed(const QString& sentence);

 private:
  void open(const session::SessionRequest& request);
  void fail(const std::exception& fault);

  experiment::Experiment experiment_;
  constraints::Constraint constraint_;
  bool isPlan_ = false, edited_ = false, endAfterTrial_ = false, resume_ = false;
  std::vector<session::BlockToRun> blocks_;  // of the plan, still to be done
  std::unique_ptr<WindowRun> run_;
  std::optional<haptics::ConductedTrial> last_;
};

}  // namespace reachlab::gui
