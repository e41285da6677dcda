#pragma once
#include <chrono>
#include <string>
#include <vector>

#include "sim/record/log/records.h"
#include "sim/record/log/tick_ring.h"

namespace reachlab::record {

/// The configuration as a log holds it, checked by the rules of the log's reader. Throws FaultError.
std::string readableText(const RunConfiguration& configuration, const std::string& origin);

/// Writes one run's log from its ticks, in blocks. One thread. Every member may throw ResourceError.
class RunWriter {
 public:
  /// The rule that cuts the log into blocks. The wall clock limits the loss when the program is killed. Ticks alone give the same bytes for
  /// the same run.
  enum class CutBy { Clock, Ticks };
  /// `diskReserve`: see RecorderOptions.
  RunWriter(const std::string& path, const RunConfiguration& configuration, std::uint64_t diskReserve = 0, CutBy cutBy = CutBy::Clock);

  void announce(const TrialSetup& setup);
  /// True when this tick ended a trial, whose record is then on the disk: `lastTrial()`.
  bool add(const QueuedTick& tick, std::span<const haptics::DeviceSample> devices, const double* row);
  void note(const std::string& text);
  /// Appends a record of another component unchanged.
  void append(RecordType type, std::span<const std::uint8_t> payload) { log_.append(type, payload); }
  void add(const std::vector<RecordedEvent>& events);
  /// Hands the gathered ticks to the kernel. `add` does so after 1000 ticks or, by the clock, after 100 ms.
  void flush();
  void flushIfDue();
  void close();

  const RecordedTrial& lastTrial() const { return lastTrial_; }

 private:
  template <class... Members>
  std::uint64_t put(RecordType type, const Members&... members) {
    ByteWriter payload;
    encode(members..., payload);
    return log_.append(type, payload.bytes());
  }
  void writeTrial(RecordedTrial trial);

  CutBy cutBy_;
  std::uint64_t diskReserve_;
  std::uint64_t lookedAt_ = 0;  // size of the log when the disk was last looked at
  LogWriter log_;
  TickBlock ticks_;
  std::vector<HandBlock> handBlocks_;  // of the second hand on, tick by tick with `ticks_`, which has the first hand
  SampleBlock samples_;
  std::vector<RecordedEvent> events_;
  TrialTracker tracker_;
  RecordedTrial lastTrial_;
  TrialLink lastLink_;
  std::uint64_t lastTick_ = 0;
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace reachlab::record
