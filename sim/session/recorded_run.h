#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/fault.h"
#include "sim/haptics/run_conductor.h"
#include "sim/haptics/timing_check.h"
#include "sim/record/log/instrument_link.h"
#include "sim/record/log/recorder.h"
#include "sim/session/session.h"

namespace reachlab::session {

/// The dataset's folder cannot be written to. The front end says how to choose another folder.
struct DatasetError : ResourceError {
  using ResourceError::ResourceError;
};

struct RecordedRunOptions {
  SessionPlace place;                         // the dataset
  bool numberAskedFor = false;                // the run number was requested: a taken number is refused, not exchanged
  bool virtualClock = false;                  // as fast as the processor allows, for a device whose hand moves by tick count
  std::uint64_t diskReserve = 1'000'000'000;  // [bytes] that the recording leaves free on the disk
  double timingCheckSeconds = 0;              // in real time: how long the loop is watched before the first trial. 0: not at all
  std::shared_ptr<haptics::LoopClock> clock;  // LoopOptions::clock
  /// Makes the engine of a station's copy. Empty: the engine of the experiment.
  std::function<std::unique_ptr<haptics::TickEngine>(const experiment::CompiledExperiment&, const haptics::EngineOptions&)> makeEngine;
  std::vector<record::Channel> furtherChannels;     // behind the channels of the scene, named kFurtherName…
  const record::FurtherColumns* further = nullptr;  // their values. Outlives the run
  std::vector<haptics::RunSink*> watchers;          // see every tick as well (a plot), may lose ticks, outlive the run
  record::InstrumentLink* instruments = nullptr;    // beside the haptic device. Outlive the run
};

/// One recorded run: an experiment on a device, trial after trial, into one log, and into the dataset at the end. Run number, folder lock,
/// recorder, repeats, timing and export come together here, for every front end. The controlling thread owns it, and the haptic thread is
/// inside. A failure throws a child of Error and leaves the finished trials safe on the disk.
///
///   RecordedRun run(block, makeDevice(…), options);
///   while (const auto trial = run.runTrial(stop)) …     // or, from a timer: putUpNext() … poll()
///   run.finish();
class RecordedRun {
 public:
  /// Compiles the scene, takes the run number under the folder's lock and creates the log. The first trial starts the loop. Throws
  /// FaultError for a missing task, a taken number, or a device in real time with a virtual clock. Throws RefusedError for a scene that
  /// cannot be computed, and DatasetError.
  RecordedRun(BlockToRun block, std::unique_ptr<haptics::HapticDevice> device, const RecordedRunOptions& options);
  /// Ends as `finish` does, and ignores a failure.
  ~RecordedRun();

  /// Prepares the next trial. False when no trial is left, or a trial is under way. Throws ResourceError. Before the first trial in real
  /// time the timing is checked. The trial is under way then, and `poll` prepares it after the check.
  bool putUpNext();
  /// Returns each ended trial once, when it is safe on the disk. If the block asks for it, an aborted trial is then queued again at the
  /// end.
  std::optional<haptics::ConductedTrial> poll();
  /// Starts the loop and waits until the timing is checked. Returns at once where there is nothing to check, and soon when `stop` becomes
  /// true.
  void checkTiming(const std::atomic<bool>& stop);
  /// Prepares the next trial and waits for its end. Nullopt when no trial is left, or when `stop` is true before it begins.
  /// When `stop` becomes true, the trial is interrupted.
  /// `looked`, if any, is called some hundred times a second meanwhile, but not on the virtual clock.
  std::optional<haptics::ConductedTrial> runTrial(const std::atomic<bool>& stop, const std::function<void()>& looked = {});
  /// Queues a finished trial again at the end, under the same index.
  void repeat(const trial::PlannedTrial& trial);
  /// Removes the last waiting repeat. False when no repeat waits.
  bool takeBackRepeat();
  /// Ends the trial under way, by the experimenter.
  void abort();
  /// A note by the experimenter, kept with its tick.
  void note(const std::string& text) { recorder_->note(text); }
  /// Samples of other stations, in a separate kind of record.
  void recordPeers(std::span<const std::uint8_t> payload) { recorder_->append(record::RecordType::PeerTicks, payload); }

  /// Interrupts the trial under way, stops the loop with zero force, notes how well it kept time and closes the log in order. Idempotent.
  /// Another thread may call it while the controlling thread calls only const members.
  void closeLog();
  /// Calls closeLog, and writes the run into the dataset by every exporter that is due. Idempotent. Throws DatasetError.
  void finish();

  /// A latched fault of the device, or its loss, in one sentence. No further trial makes sense.
  std::optional<std::string> fault() const { return conductor_->fault(); }

  bool underWay() const { return awaited_ || conductor_->underWay(); }
  std::size_t trialsLeft() const { return conductor_->trialsLeft(); }
  /// The trial that `putUpNext` would prepare. Null when no trial is left.
  const trial::PlannedTrial* nextPlanned() const { return conductor_->nextPlanned(); }
  std::size_t trialCount() const { return trialCount_; }  // with repeats
  const haptics::TickState& latest() const { return conductor_->latest(); }
  haptics::LoopReport report() const { return conductor_->report(); }
  const dynamics::MethodChoice& choice() const { return choice_; }
  const record::RunConfiguration& configuration() const { return block_.configuration; }
  const experiment::CompiledExperiment& experiment() const { return block_.experiment; }
  /// The warnings of its scenes, each once.
  std::vector<Fault> warnings() const;
  /// The experiment of a trial, by its kind and target.
  const experiment::CompiledExperiment& experimentOf(const trial::PlannedTrial& trial) const {
    return block_.scenes.at(static_cast<std::size_t>(trial.scene));
  }
  /// That of the trial under way, else of the next trial, else of the block.
  const experiment::CompiledExperiment& experimentNow() const {
    const trial::PlannedTrial* trial = conductor_->currentTrial();
    return trial != nullptr ? experimentOf(*trial) : block_.experiment;
  }
  const std::string& logPath() const { return block_.logPath; }
  const std::string& instructions() const { return block_.instructions; }
  /// The last trial that is safe on the disk, with its times by the clock.
  record::RecordedTrial lastTrial() const { return recorder_->lastTrial(); }
  /// The timing before the first trial. Nullopt until it was checked, and on the virtual clock. Also a note in the log.
  const std::optional<haptics::TimingVerdict>& timingVerdict() const { return timingVerdict_; }
  /// The timing of the loop, in one line. Empty until the log is closed, and on the virtual clock.
  const std::string& timing() const { return timing_; }
  /// The trial's number as recorded. A resumed block continues the numbers.
  int numberOf(const haptics::ConductedTrial& trial) const { return block_.configuration.firstTrial - 1 + trial.trial; }

 private:
  void completeConfiguration();
  void openLog();
  void start();
  bool checksTiming();
  void takeEnded(const haptics::ConductedTrial& trial);

  BlockToRun block_;
  RecordedRunOptions options_;
  dynamics::MethodChoice choice_;
  std::size_t trialCount_ = 0, conducted_ = 0;
  bool started_ = false, closed_ = false, finished_ = false;
  bool awaited_ = false;  // a trial waits for the timing check
  std::int64_t checkUntilNs_ = 0;
  std::optional<haptics::TimingVerdict> timingVerdict_;
  std::string timing_;
  std::unique_ptr<record::Recorder> recorder_;
  std::unique_ptr<haptics::RunSink> sink_;            // recorder and watchers
  std::unique_ptr<haptics::RunConductor> conductor_;  // last: its loop ends before the members that it writes to
};

}  // namespace reachlab::session
