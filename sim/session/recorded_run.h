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

/// The dataset's folder cannot be written to: the front end says how another one is chosen.
struct DatasetError : ResourceError {
  using ResourceError::ResourceError;
};

struct RecordedRunOptions {
  SessionPlace place;                         // the dataset
  bool numberAskedFor = false;                // the block's run number was asked for: a taken one is refused, not exchanged
  bool virtualClock = false;                  // as fast as the processor allows; needs a device whose hand moves by tick count
  std::uint64_t diskReserve = 1'000'000'000;  // [bytes] that the recording leaves free on the disk
  double timingCheckSeconds = 0;              // in real time: how long the loop is watched before the first trial; 0: not at all
  std::shared_ptr<haptics::LoopClock> clock;  // LoopOptions::clock
  /// Makes the engine where it is none of one experiment on its own (a station's copy); empty: the experiment's.
  std::function<std::unique_ptr<haptics::TickEngine>(const experiment::CompiledExperiment&, const haptics::EngineOptions&)> makeEngine;
  std::vector<record::Channel> furtherChannels;     // behind those of the scene, named kFurtherName…
  const record::FurtherColumns* further = nullptr;  // what stands in them; outlives the run
  std::vector<haptics::RunSink*> watchers;          // see every tick as well (a plot), may lose them, outlive the run
  record::InstrumentLink* instruments = nullptr;    // beside the haptic device; outlive the run
};

/// One run, recorded: an experiment on a device, trial after trial, into a log of its own, and into the dataset at the end. The one place
/// where run number, folder lock, recorder, repeats, timing and export come together, for every front end. The controlling thread owns it;
/// the haptic thread is inside. What can fail throws a child of Error and leaves the finished trials safe on the disk.
///
///   RecordedRun run(block, makeDevice(…), options);
///   while (const auto trial = run.runTrial(stop)) …     // or, from a timer: putUpNext() … poll()
///   run.finish();
class RecordedRun {
 public:
  /// Compiles the scene, takes the run number under the folder's lock and creates the log. The first trial starts the loop. Throws FaultError (no task, the
  /// device moves in real time and the clock is virtual, the number is taken), RefusedError (the scene cannot be computed), DatasetError.
  RecordedRun(BlockToRun block, std::unique_ptr<haptics::HapticDevice> device, const RecordedRunOptions& options);
  /// Ends as `finish` does, without a word where that fails.
  ~RecordedRun();
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  /// Puts the next trial up. False when none is left, or one is under way. Throws ResourceError, as all that writes. Before the first
  /// trial in real time the timing is checked: the trial is under way then, and `poll` puts it up when the check is over.
  bool putUpNext();
  /// The trial that has ended and is safe on the disk, once; an aborted one has then been put up once more at the end, if the block wants it.
  std::optional<haptics::ConductedTrial> poll();
  /// Starts the loop and waits until the timing is checked; returns at once where there is nothing (more) to check, soon when `stop` becomes
  /// true.
  void checkTiming(const std::atomic<bool>& stop);
  /// Puts the next trial up and waits for its end; nullopt when none is left. When `stop` becomes true, the trial is interrupted. `looked`, if
  /// any, is called some hundred times a second meanwhile; not on the virtual clock.
  std::optional<haptics::ConductedTrial> runTrial(const std::atomic<bool>& stop, const std::function<void()>& looked = {});
  /// Puts a trial that is over up once more at the end, under its own index.
  void repeat(const trial::PlannedTrial& trial);
  /// Takes the last repeat back that is still to be done. False when there is none.
  bool takeBackRepeat();
  /// Ends the trial under way, by the experimenter.
  void abort();
  /// A note by the experimenter, kept with the tick it was made at.
  void note(const std::string& text) { recorder_->note(text); }
  /// What other stations sent, as their own kind of record.
  void recordPeers(std::span<const std::uint8_t> payload) { recorder_->append(record::RecordType::PeerTicks, payload); }

  /// Interrupts the trial under way, stops the loop with zero force, notes how well it kept time and closes the log: all that was recorded is
  /// then in order. Idempotent. Also from another thread, while the controlling one calls nothing that is not const.
  void closeLog();
  /// closeLog, and writes the run into the dataset by every exporter that is due. Idempotent. Throws DatasetError.
  void finish();

  /// What has latched on the device, or that it is lost, in one sentence: no further trial makes sense.
  std::optional<std::string> fault() const { return conductor_->fault(); }

  bool underWay() const { return awaited_ || conductor_->underWay(); }
  std::size_t trialsLeft() const { return conductor_->trialsLeft(); }
  /// What `putUpNext` would put up; null when nothing is left.
  const trial::PlannedTrial* nextPlanned() const { return conductor_->nextPlanned(); }
  std::size_t trialCount() const { return trialCount_; }  // with repeats
  const haptics::TickState& latest() const { return conductor_->latest(); }
  haptics::LoopReport report() const { return conductor_->report(); }
  const dynamics::MethodChoice& choice() const { return choice_; }
  const record::RunConfiguration& configuration() const { return block_.configuration; }
  const experiment::CompiledExperiment& experiment() const { return block_.experiment; }
  const std::string& logPath() const { return block_.logPath; }
  const std::string& instructions() const { return block_.instructions; }
  /// The last trial that is safe on the disk, with what the clock says of it.
  record::RecordedTrial lastTrial() const { return recorder_->lastTrial(); }
  /// How the timing was before the first trial; nullopt until it was checked, and on the virtual clock. Also a note in the log.
  const std::optional<haptics::TimingVerdict>& timingVerdict() const { return timingVerdict_; }
  /// How well the loop kept time, in one line; empty until the log is closed, and on the virtual clock.
  const std::string& timing() const { return timing_; }
  /// The trial's number as recorded: a block that was resumed goes on counting.
  int numberOf(const haptics::ConductedTrial& trial) const { return block_.configuration.firstTrial - 1 + trial.trial; }

 private:
  void completeConfiguration();
  void openLog();
  void start();
  void keepInstrumentEvents();
  bool checksTiming();
  void repeatIfAborted(const haptics::ConductedTrial& trial);

  BlockToRun block_;
  RecordedRunOptions options_;
  dynamics::MethodChoice choice_;
  std::size_t trialCount_ = 0, conducted_ = 0;
  bool started_ = false, closed_ = false, finished_ = false;
  bool awaited_ = false;  // a trial is to be put up when the timing is checked
  std::int64_t checkUntilNs_ = 0;
  std::optional<haptics::TimingVerdict> timingVerdict_;
  std::string timing_;
  std::unique_ptr<record::Recorder> recorder_;
  std::unique_ptr<haptics::RunSink> sink_;            // recorder and who sees the ticks as well
  std::unique_ptr<haptics::RunConductor> conductor_;  // last: its loop ends before what it writes to
};

}  // namespace reachlab::session
