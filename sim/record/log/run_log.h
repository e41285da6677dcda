#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "sim/record/configuration/run_configuration.h"
#include "sim/record/log/log.h"
#include "sim/trial/outcome.h"

namespace reachlab::record {

/// A trial as it was prepared before it began. It links the trial's number to the planned order.
struct TrialSetup {
  std::int32_t trial = 0;  // as the recording numbers it, never used twice in a run
  trial::PlannedTrial planned;
};

/// The logged values of a tick beside its hands.
struct TickStamp {
  std::uint64_t tick = 0;
  std::int64_t measuredNs = 0;  // monotonic clock of the computer
  trial::Command command = trial::Command::None;
  std::uint32_t missedTicks = 0;  // whole periods skipped before this tick
};
/// A raw tick as in its log record. With the samples of further hands and the configuration it is enough to simulate the run again.
struct RecordedTick : TickStamp {
  haptics::DeviceSample device;  // of the first hand
};

enum class EventKind : std::uint8_t {
  TrialStart = 1,  // the trial was put up
  Armed = 2,       // the hand was at the start
  Go = 3,          // go signal
  Onset = 4,       // the hand moved: t = 0
  TrialEnd = 5,
  ClampBegin = 6,  // the device gets less force than the object gives
  ClampEnd = 7,
  DeviceLost = 8,
  DeviceBack = 9,
  TicksMissed = 10,
  StepFault = 11,     // a step did not end well; `value` is its StepStatus
  Note = 12,          // by the experimenter
  DeviceState = 13,   // of a device that renders force; `value` is its haptics::DeviceState, `text` its name
  Intervention = 14,  // of the safety layer, `text` its name; `value` 1 when it begins, 0 when it has ended
  // sent to another instrument or received from it, as `text` says. `value` of a sent event: [s] after the tick's clock
  Instrument = 15,
  ChannelBroken = 16,  // the hand was further from the line than a channel allows, and the channel lets go
};
inline constexpr EventKind kLastEventKind = EventKind::ChannelBroken;
std::string_view nameOf(EventKind kind);

struct RecordedEvent {
  std::uint64_t tick = 0;
  EventKind kind = EventKind::Note;
  std::int32_t trial = 0;
  double value = 0;
  std::string text;
};

/// One trial of a run with its result and simple measures. An unfinished trial of a log that broke off is `Interrupted` by
/// `Program`.
struct RecordedTrial {
  int trial = 0;                // from 1; a resumed block goes on counting
  trial::PlannedTrial planned;  // a repeated trial has the index of its predecessor
  trial::TrialResult result;
  std::uint64_t startTick = 0, armedTick = 0, goTick = 0;  // 0: never came
  std::uint64_t lastTick = 0;                              // last tick that belongs to the trial
  double peakHandSpeed = 0;                                // [m/s] largest over every tick of the movement
  double handPathLength = 0;                               // [m] from onset to the end
  double peakForce = 0;                                    // [N] largest coupling force
  double meanForce = 0;                                    // [N]
  std::uint64_t clampedTicks = 0, missedTicks = 0;
  std::uint64_t droppedTicks = 0;                             // that the recorder lost because the disk was too slow
  double elapsed = std::numeric_limits<double>::quiet_NaN();  // [s] from go to the end by the computer's clock; NaN: no go
  bool channelBroken = false;                                 // EventKind::ChannelBroken came in this trial
  bool complete = true;                                       // false: the log broke off in this trial
  std::uint64_t offset = 0;                                   // where in the log reading of this trial starts,
  std::uint32_t sequence = 0;                                 // and the number of the record there
};
/// A trial that begins at `tick`, planned as the latest of its setups says.
RecordedTrial beginTrial(int number, int index, std::uint64_t tick, const std::vector<TrialSetup>& setups);
/// Ends, at its last tick, a trial that has no result.
void breakOff(RecordedTrial& trial);

/// Rows of the derived channels: row-major, table.size() numbers per row.
struct SampleRows {
  std::size_t columns = 0;
  std::vector<std::uint64_t> ticks;
  std::vector<double> values;
  std::size_t size() const { return ticks.size(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns + column]; }
  /// The vector whose x is in that column.
  Vec3 vectorAt(std::size_t row, std::size_t column) const { return {at(row, column), at(row, column + 1), at(row, column + 2)}; }
  /// The rows between two ticks, both included.
  SampleRows between(std::uint64_t first, std::uint64_t last) const;
};

/// Everything: every record's CRC, up to the first damage. Trials: only the chain of trial records, last to first. The cost then follows
/// the number of trials and not the bytes. Rows are checked when they are read.
enum class LogCheck { Everything, Trials };

/// One recorded run, read to its last good record. Rows and ticks are read when asked for. Any thread, one at a time.
class RunLog {
 public:
  /// Throws FaultError (not a log, configuration damaged) or ResourceError.
  static RunLog open(const std::string& path, LogCheck check = LogCheck::Everything);

  const std::string& path() const { return path_; }
  const RunConfiguration& configuration() const { return configuration_; }
  const std::vector<RecordedTrial>& trials() const { return trials_; }
  /// Closed in order, and undamaged to the last byte.
  bool healthy() const { return healthy_; }
  bool closed() const { return closed_; }
  std::uint64_t goodBytes() const { return goodBytes_; }
  std::uint64_t fileBytes() const { return fileBytes_; }

  /// Rows between two ticks, both included. Throws FaultError if the log has changed meanwhile.
  SampleRows rows(std::uint64_t firstTick, std::uint64_t lastTick) const;
  /// Rows of a trial (from trials()), from its preparation to its end.
  SampleRows rows(const RecordedTrial& trial) const { return rows(trial.startTick, trial.lastTick); }
  SampleRows allRows() const;
  /// Tick of the first row, from which every export counts its times. 0 where there are no rows.
  std::uint64_t firstSampleTick() const;
  /// The rows block by block as they were written, for runs longer than memory. A block is valid only until `take` returns.
  void eachBlock(const std::function<void(const SampleRows& block)>& take) const;
  std::vector<RecordedTick> ticks() const;
  /// The raw samples of the further hands, from hand 2. Each list is as long as `ticks()` unless the log broke off in between. Empty where
  /// there is one hand.
  std::vector<std::vector<haptics::DeviceSample>> otherTicks() const;
  std::vector<RecordedEvent> events() const;
  std::vector<TrialSetup> setups() const;

 private:
  RunLog() = default;
  bool readChain(LogReader& reader);
  void scan(LogReader& reader);
  void placeInScene(trial::PlannedTrial& planned) const;
  /// The payloads of a type from the trial of `firstTick` on. `take` may answer false, which ends it.
  template <typename Take>
  void each(RecordType type, std::uint64_t firstTick, Take&& take) const;

  std::string path_;
  RunConfiguration configuration_;
  std::vector<RecordedTrial> trials_;
  bool healthy_ = false, closed_ = false;
  std::uint64_t goodBytes_ = 0, fileBytes_ = 0;
};

/// The logs of a dataset, a session's folder or a single file, sorted by name. Throws FaultError when no log is found.
std::vector<std::string> findLogs(const std::string& path);

}  // namespace reachlab::record
