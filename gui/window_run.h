#pragma once
#include <memory>
#include <optional>
#include <string>

#include "gui/trial_trace.h"
#include "sim/haptics/run_conductor.h"
#include "sim/record/recorder.h"
#include "sim/session/session.h"

namespace reachlab::devices {
class MouseDevice;
}

namespace reachlab::gui {

/// One run as the window conducts it: device, haptic loop, recorder and the plot's trace, from a planned block. The window's thread owns
/// it; the haptic thread is inside. Everything that can fail throws a child of Error and leaves the finished trials on the disk.
class WindowRun {
 public:
  /// Makes the device ("mouse" here, all others by makeDevice), compiles the scene, opens the log (none if block.logPath is empty) and
  /// starts the loop.
  WindowRun(const session::BlockToRun& block, const std::string& device, const std::string& dataFolder);
  ~WindowRun();
  WindowRun(const WindowRun&) = delete;
  WindowRun& operator=(const WindowRun&) = delete;

  bool putUpNext() { return conductor_->putUpNext(); }
  std::optional<haptics::ConductedTrial> poll() { return conductor_->poll(); }
  bool underWay() const { return conductor_->underWay(); }
  std::size_t trialsLeft() const { return conductor_->trialsLeft(); }
  void abort() { conductor_->abort(); }
  void interrupt() { conductor_->interrupt(); }
  /// Puts a trial that is over at the end of the plan once more, under its own index.
  void repeat(const trial::PlannedTrial& trial);
  void note(const std::string& text);
  /// The mouse's hand; other devices ignore it.
  void pointTo(const Vec3& hand);
  /// Stops the loop with zero force, closes the log and writes the run into the dataset. Idempotent.
  void finish();

  const haptics::TickState& latest() const { return conductor_->latest(); }
  bool tryTake(TracePoint& point) { return sink_->tryTake(point); }
  haptics::LoopReport report() const { return conductor_->report(); }
  const dynamics::MethodChoice& choice() const { return choice_; }
  const record::RunConfiguration& configuration() const { return configuration_; }
  const std::string& logPath() const { return logPath_; }
  int firstTrial() const { return configuration_.firstTrial; }
  std::size_t trialCount() const { return trialCount_; }
  bool usesMouse() const { return mouse_ != nullptr; }

 private:
  record::RunConfiguration configuration_;
  std::string logPath_, dataFolder_;
  bool finished_ = false;
  dynamics::MethodChoice choice_;
  std::size_t trialCount_ = 0;
  devices::MouseDevice* mouse_ = nullptr;  // inside the conductor
  std::unique_ptr<record::Recorder> recorder_;
  std::unique_ptr<TraceSink> sink_;
  std::unique_ptr<haptics::RunConductor> conductor_;  // last: its loop ends before what it writes to
};

}  // namespace reachlab::gui
