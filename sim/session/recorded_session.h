#pragma once
#include <functional>
#include <memory>
#include <span>
#include <utility>

#include "sim/session/pacing.h"
#include "sim/session/recorded_run.h"

namespace reachlab::session {

/// Makes the requested device for one block, from its scenes and its seed. Throws as devices' makeDevice does.
using DeviceMaker = std::function<std::unique_ptr<haptics::HapticDevice>(
    const std::string& device, std::span<const experiment::CompiledExperiment> scenes, std::uint64_t seed)>;

/// A session while it is recorded. Its blocks are in order, with one run each, and one run is open at a time. The command line uses
/// `conduct`, and a window opens run after run. The controlling thread owns it.
class RecordedSession {
 public:
  /// Plans the session and opens nothing. `watcher` (may be null) sees every tick of every run. `watcher` and `instruments` outlive the
  /// session. Throws FaultError.
  RecordedSession(const Programme& programme, const SessionRequest& request, DeviceMaker makeDevice, haptics::RunSink* watcher = nullptr,
                  record::InstrumentLink* instruments = nullptr);
  /// A change to the options of every run before it is opened, such as its engine or its watchers.
  void prepareRuns(std::function<void(RecordedRunOptions&)> prepare) { prepare_ = std::move(prepare); }

  /// The warnings before it begins.
  const SessionNotice& notice() const { return session_.notice; }
  std::uint64_t seed() const { return session_.seed; }
  std::size_t blocksLeft() const { return session_.blocks.size(); }
  const BlockToRun* nextBlock() const { return session_.blocks.empty() ? nullptr : &session_.blocks.front(); }  // null: no block is left

  /// To be called when a trial of the run has ended. It begins the plan's pause before the next trial or, after the last trial, the plan's
  /// rest before the next block. `ownPause` [s] holds where the plan has no pause. Without both, the next trial waits for a request. The
  /// virtual clock has no pauses and no rests.
  void trialEnded(Pacing::Time now, std::optional<double> ownPause);
  Pacing& pacing() { return pacing_; }
  /// Finishes the open run, if any, and opens the run of the next block. False when no block is left. A block whose run could not be opened
  /// is still left.
  bool openNext();
  /// Finishes the open run. The blocks after it stay.
  void closeRun();
  RecordedRun* run() { return run_.get(); }  // null: no run is open

 private:
  SessionRequest request_;
  DeviceMaker makeDevice_;
  haptics::RunSink* watcher_;
  record::InstrumentLink* instruments_;
  std::function<void(RecordedRunOptions&)> prepare_;
  SessionToRun session_;
  std::unique_ptr<RecordedRun> run_;
  Pacing pacing_;
};

/// Calls to a front end while a session is conducted to its end.
struct SessionWords {
  std::function<void(const BlockToRun& next)> resting;  // the plan rests before this block, from the end of the last trial. May be empty
  std::function<void(const RecordedRun& run)> opened;   // before the loop starts
  std::function<void(const RecordedRun& run)> checked;  // RecordedRun::timingVerdict is known. In real time only, before the first trial
  /// In real time, 3 s after a trial was prepared and then every 10 s, while the hand does not rest at its start. Without a window nothing
  /// else tells the person what the trial waits for. May be empty.
  std::function<void(const RecordedRun& run)> waiting;
  std::function<void(const RecordedRun& run, const haptics::ConductedTrial& trial)> ended;  // the trial is safe on the disk
  std::function<void(const RecordedRun& run)> logClosed;                                    // the recording is complete
  std::function<void()> closed;  // the run is in the dataset, and its log is let go of
};

/// Conducts every remaining block, trial by trial, with the plan's pauses. When `stop` becomes true, the trial under way is kept as
/// interrupted and its run is closed in order. The remaining blocks stay. Returns true when no block is left.
bool conduct(RecordedSession& session, const std::atomic<bool>& stop, const SessionWords& words);

}  // namespace reachlab::session
