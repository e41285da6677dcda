#pragma once
#include <memory>
#include <string>

#include "sim/haptics/run_sink.h"
#include "sim/record/configuration/run_configuration.h"
#include "sim/record/log/log.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Further numbers at the end of a row, one for each channel beyond those of the scene. A station uses them to record how its copy differs
/// from the other copies.
class FurtherColumns {
 public:
  virtual ~FurtherColumns() = default;
  /// Haptic thread. Never allocates.
  virtual void fill(double* columns) const noexcept = 0;
};

struct RecorderOptions {
  bool threaded = true;                       // false: written by the caller (virtual clock), so that nothing can be dropped
  std::uint64_t diskReserve = 1'000'000'000;  // [bytes] or 5 % of the disk, whichever is less: recording ends before the disk has no more
  std::size_t queueTicks = 4096;              // how many ticks the disk may be behind before ticks are dropped and counted
  const FurtherColumns* further = nullptr;    // outlives the ticks; null where the table is the scene's
};

/// The history unit: turns ticks into the log of one run. In real time the haptic thread hands ticks over without waiting, and a thread of
/// the recorder writes. Blocks reach the kernel at least every 100 ms.
class Recorder : public haptics::RunSink {
 public:
  /// Creates the log at `path` and writes the configuration. Throws ResourceError.
  Recorder(const std::string& path, const RunConfiguration& configuration, const RecorderOptions& options = {});
  ~Recorder() override;

  /// Haptic thread, every tick. Never waits, allocates or throws. False when the queue was full: the tick is lost and must be counted
  /// (LoopFaults::droppedRecords).
  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept override;

  /// Ticks between two rows, at most a hundredth of a second, so that the window's picture does not lag.
  std::uint32_t massesEvery() const noexcept override;

  /// Controlling thread, before a trial starts: the planned trial of the engine's `trial`-th trial (from 1). Throws ResourceError.
  void announce(std::int32_t trial, const trial::PlannedTrial& planned) override;
  /// Controlling thread, after the engine's `trial`-th trial has ended. Returns once its record is on the disk (fdatasync). Throws
  /// ResourceError when the disk is full or gone. Earlier synced records stay good.
  void awaitTrial(std::int32_t trial) override;
  /// The last trial that awaitTrial has confirmed on the disk.
  RecordedTrial lastTrial() const;
  /// A note by the experimenter. Controlling thread.
  void note(const std::string& text);
  /// Appends a record of another component unchanged. Controlling thread. Throws ResourceError.
  void append(RecordType type, std::span<const std::uint8_t> payload);
  /// Appends events of other instruments, which carry their own ticks. Controlling thread.
  void add(const std::vector<RecordedEvent>& events);
  /// Ends the log in order. Throws like awaitTrial.
  void close() override;

  /// The first fault of the disk, empty while all is well. Any thread.
  std::string fault() const;
  /// Processor time of the recorder's thread so far [s], 0 when not threaded.
  double processorSeconds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::record
