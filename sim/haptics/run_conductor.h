#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/haptic_loop.h"

namespace reachlab::haptics {

struct ConductedTrial {
  std::int32_t trial = 0;  // from 1 within the run
  trial::PlannedTrial planned;
  trial::TrialResult result;
};

/// Conducts one run: one experiment on one device, trial after trial. The command line calls `runTrial` and waits. The window calls
/// `putUpNext` and `poll` from a timer. The controlling thread owns it and the haptic thread is inside.
///
///   RunConductor run(experiment, makeDevice("simulated", experiment, seed), trials);
///   run.start(&sink);                        // the sink was made from run.engine() and run.device()
///   while (run.putUpNext()) … run.poll() …   // or run.runTrial(interrupt)
///   run.finish();
class RunConductor {
 public:
  /// The engine was made for this device.
  RunConductor(std::unique_ptr<TickEngine> engine, std::unique_ptr<HapticDevice>&& device, std::vector<trial::PlannedTrial> trials,
               const LoopOptions& options);
  /// The same for one experiment, which is compiled. Throws as TickEngine's constructor does.
  RunConductor(const experiment::CompiledExperiment& experiment, std::unique_ptr<HapticDevice> device,
               std::vector<trial::PlannedTrial> trials, const LoopOptions& options = {});
  ~RunConductor();

  const TickEngine& engine() const { return loop_ ? loop_->engine() : *engine_; }  // constants only while running
  DeviceInfo device() const { return device_->info(); }
  /// Of each hand's own device.
  std::vector<DeviceInfo> hands() const { return engineOptions(*device_).hands; }

  /// Starts the loop. Ticks are given to `sink`, which outlives the run and may be null.
  void start(RunSink* sink);

  /// Queues the next planned trial. False if no trial is left or a trial is under way. May throw ResourceError from the sink.
  bool putUpNext();
  /// One more trial at the end of the plan (a repetition keeps its index).
  void append(const trial::PlannedTrial& trial) { trials_.push_back(trial); }
  /// Removes the last appended trial that is still to come. False if there is no such trial.
  bool takeBackAppended();
  std::size_t trialsLeft() const { return trials_.size() - next_; }
  const trial::PlannedTrial* nextPlanned() const { return next_ < trials_.size() ? &trials_[next_] : nullptr; }
  bool underWay() const { return underWay_; }
  /// The trial under way, else the next trial. Null if no trial is left.
  const trial::PlannedTrial* currentTrial() const { return underWay_ ? &trials_[next_ - 1] : nextPlanned(); }

  /// Looks at the newest state, and returns the trial under way once it has ended and is safe on the disk. Waits for the disk but not for
  /// the trial. A trial whose device does not call or answer any more is ended as lost. May throw ResourceError from the sink, and if a
  /// call of the device hangs while no trial is under way. `finish` then leaves that call behind. On the virtual clock it computes the
  /// trial to its end.
  std::optional<ConductedTrial> poll();
  /// After `poll`: the newest state seen.
  const TickState& latest() const { return *latest_; }
  /// Ends the trial under way: by the experimenter, or because the program is asked to stop.
  void abort() { loop_->tryCommand(trial::Command::Abort); }
  void interrupt() { loop_->tryCommand(trial::Command::Interrupt); }

  /// putUpNext and poll until the trial has ended. nullopt if no trial is left. When `stop` becomes true, the trial is interrupted.
  /// `looked`, if given, is called after each look at a trial that has not ended. It is not called on the virtual clock.
  std::optional<ConductedTrial> runTrial(const std::atomic<bool>& stop, const std::function<void()>& looked = {});

  /// Stops the loop, zero force, closes the sink. Idempotent.
  void finish();
  LoopReport report() const { return loop_ ? loop_->report() : LoopReport{}; }

  /// One sentence about a latched fault or loss of the device. nullopt if the device is well. The caller ends the run with this sentence.
  std::optional<std::string> fault() const;

 private:
  void advanceUntilDone(const std::atomic<bool>* stop);

  std::shared_ptr<HapticDevice> device_;  // shared with the loop, which may have to leave a hanging call behind
  std::unique_ptr<TickEngine> engine_;    // until `start`
  LoopOptions options_;
  std::vector<trial::PlannedTrial> trials_;
  std::size_t planned_ = 0;  // so many of them were not appended
  std::size_t next_ = 0;
  std::int32_t trial_ = 0;
  bool underWay_ = false, finished_ = false;
  RunSink* sink_ = nullptr;
  std::unique_ptr<HapticLoop> loop_;
  std::unique_ptr<TickState> first_;
  const TickState* latest_;
};

}  // namespace reachlab::haptics
