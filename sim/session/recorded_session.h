#pragma once
#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "sim/session/pacing.h"
#include "sim/session/recorded_run.h"

namespace reachlab::session {

/// Makes the device that was asked for, for one block: its experiment and its seed. Throws as devices' makeDevice does.
using DeviceMaker = std::function<std::unique_ptr<haptics::HapticDevice>(
    const std::string& device, const experiment::CompiledExperiment& experiment, std::uint64_t seed)>;

/// A session as it is recorded: its blocks in order, one run each, one open at a time. The command line goes through it with `conduct`; a
/// window opens run after run. The controlling thread owns it.
class RecordedSession {
 public:
  /// Plans the session; opens nothing. `watcher` (may be null) sees every tick of every run and outlives the session; so do `instruments`. Throws FaultError.
  RecordedSession(const Programme& programme, const SessionRequest& request, DeviceMaker makeDevice, haptics::RunSink* watcher = nullptr,
                  record::InstrumentLink* instruments = nullptr);
  /// What is changed of every run's options before it is opened: whose engine it has, who else sees its ticks.
  void prepareRuns(std::function<void(RecordedRunOptions&)> prepare) { prepare_ = std::move(prepare); }

  /// What is worth a word before it begins.
  const SessionNotice& notice() const { return notice_; }
  std::uint64_t seed() const { return seed_; }
  std::size_t blocksLeft() const { return blocks_.size(); }
  const BlockToRun* nextBlock() const { return blocks_.empty() ? nullptr : &blocks_.front(); }  // null: none is left

  /// To be called when a trial of the run has ended: begins the plan's pause before the run's next trial or, after its last, the plan's rest
  /// before the next block. `ownPause` [s] stands where the plan has no pause; without it the next trial waits to be asked for. On the
  /// virtual clock nobody pauses or rests.
  void trialEnded(Pacing::Time now, std::optional<double> ownPause);
  Pacing& pacing() { return pacing_; }
  /// Finishes the run that is open, if any, and opens that of the next block; false when no block is left. A block whose run could not be
  /// opened is still left.
  bool openNext();
  /// Finishes the run that is open. The blocks after it stay.
  void closeRun();
  RecordedRun* run() { return run_.get(); }  // null: none is open

 private:
  SessionRequest request_;
  DeviceMaker makeDevice_;
  haptics::RunSink* watcher_;
  record::InstrumentLink* instruments_;
  std::function<void(RecordedRunOptions&)> prepare_;
  SessionNotice notice_;
  std::uint64_t seed_ = 0;
  std::deque<BlockToRun> blocks_;  // to be opened yet
  std::unique_ptr<RecordedRun> run_;
  Pacing pacing_;
};

/// What a front end is told while a session is conducted to its end.
struct SessionWords {
  std::function<void(const BlockToRun& next)> resting;  // the plan rests before this block, from the end of the last trial; may be empty
  std::function<void(const RecordedRun& run)> opened;   // before the loop starts
  std::function<void(const RecordedRun& run)> checked;  // RecordedRun::timingVerdict is there; in real time only, before the first trial
  /// In real time, 3 s after a trial was put up and every 10 s from then on, while the hand does not rest at its start: a person waits for
  /// nothing else, and where no window shows the start nothing else says so. May be empty.
  std::function<void(const RecordedRun& run)> waiting;
  std::function<void(const RecordedRun& run, const haptics::ConductedTrial& trial)> ended;  // the trial is safe on the disk
  std::function<void(const RecordedRun& run)> logClosed;                                    // all that was recorded is in order
  std::function<void(const RecordedRun& run)> closed;                                       // and in the dataset
};

/// Does every block that is left, trial by trial, with the plan's pauses; when `stop` becomes true the trial under way is kept as
/// interrupted, its run is closed in order, and the rest is left. Returns true when nothing is left.
bool conduct(RecordedSession& session, const std::atomic<bool>& stop, const SessionWords& words);

}  // namespace reachlab::session
