#pragma once
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sim/experiment/experiment.h"
#include "sim/record/log/log.h"
#include "sim/record/log/recorder.h"
#include "sim/record/log/records.h"
#include "sim/record/log/run_log.h"
#include "test_paths.h"
#include "tests/temporary_folder.h"

namespace reachlab::record {

inline RunConfiguration madeConfiguration(int masses = 2, std::size_t hands = 1) {
  experiment::Experiment experiment;
  experiment.object.kind = experiment::ObjectKind::Chain;
  experiment.object.masses.assign(static_cast<std::size_t>(masses), 0.6);
  if (hands > 1) experiment.hands.resize(hands);
  RunConfiguration configuration;
  configuration.task = "made";
  configuration.experimentName = configuration.condition = "made";
  configuration.seed = 18446744073709551615ull;  // the largest: no reader may pass it through a double
  configuration.device = "made";
  configuration.startedUtc = "2026-11-20T10:00:00.000Z";
  configuration.table = makeChannelTable(experiment, 1);
  configuration.otherHands.resize(hands - 1);
  return configuration;
}

/// A run that no physics made: every number is a known function of the tick, so that any row can be checked on its own.
class MadeRun {
 public:
  static constexpr std::uint64_t kWaiting = 20, kArmed = 30, kMoving = 200, kDone = 25;
  static constexpr std::uint64_t kTicksPerTrial = kWaiting + kArmed + kMoving + kDone;

  explicit MadeRun(int masses = 2) : state_(std::make_unique<haptics::TickState>()) { state_->massCount = masses; }

  static double valueAt(std::uint64_t tick) { return std::sin(0.01 * static_cast<double>(tick)) / 3; }

  /// The state at the next tick.
  haptics::TickState& next() {
    haptics::TickState& s = *state_;
    const std::uint64_t tick = tick_++;
    const std::uint64_t within = tick % kTicksPerTrial;
    s.tick = tick;
    s.measuredNs = static_cast<std::int64_t>(tick) * 1000003;
    s.trial = static_cast<std::int32_t>(tick / kTicksPerTrial) + 1;
    s.phase = within < kWaiting                      ? trial::Phase::Waiting
              : within < kWaiting + kArmed           ? trial::Phase::Armed
              : within < kWaiting + kArmed + kMoving ? trial::Phase::Moving
                                                     : trial::Phase::Done;
    const double x = valueAt(tick);
    s.hands[0].device.position = {x, -x, 2 * x};
    s.hands[0].hip.position = {x, -x, 2 * x};
    s.hands[0].hip.velocity = {x / 7, 0, 0};
    s.hands[0].couplingForce = {10 * x, 0, 0};
    s.hands[0].feedbackForce = s.hands[0].deviceForce = {-10 * x, 0, 0};
    s.energy = x * x;
    for (int i = 0; i < s.massCount; ++i) s.masses[static_cast<std::size_t>(i)].r = {x + i, 0, 0};
    if (s.phase == trial::Phase::Done) {
      s.result.outcome = s.trial % 2 == 0 ? trial::Outcome::Failure : trial::Outcome::Success;
      s.result.reason = s.trial % 2 == 0 ? trial::Reason::Velocity : trial::Reason::None;
      s.result.mass = s.trial % 2 == 0 ? 2 : 0;
      s.result.by = s.trial % 2 == 0 ? 0.001 * s.trial : 0;
      s.result.movementTime = 0.001 * kMoving;
      s.result.onsetTick = tick - within + kWaiting + kArmed;
      s.result.endTick = tick - within + kWaiting + kArmed + kMoving;
    }
    return s;
  }

 private:
  std::unique_ptr<haptics::TickState> state_;  // large
  std::uint64_t tick_ = 0;
};

/// A recording of a made run, as far as a test has taken it.
class MadeRecording {
 public:
  explicit MadeRecording(const std::string& path, const RunConfiguration& configuration = madeConfiguration(),
                         const RecorderOptions& options = {.threaded = false})
      : recorder(path, configuration, options), path_(path), run_(configuration.table.massCount) {}
  /// Goes on to the tick before `end`. `edit` may change a state before it is recorded, or leave it out by false.
  template <typename Edit>
  void until(std::uint64_t end, Edit&& edit) {
    for (; tick_ < end; ++tick_) {
      haptics::TickState& state = run_.next();
      const bool first = tick_ % MadeRun::kTicksPerTrial == 0;
      if (edit(state)) recorder.onTick(state, first ? trial::Command::NextTrial : trial::Command::None, 0);
    }
  }
  void until(std::uint64_t end) {
    until(end, [](const haptics::TickState&) { return true; });
  }
  RunLog closed() {
    recorder.close();
    return RunLog::open(path_);
  }

  Recorder recorder;

 private:
  std::string path_;
  MadeRun run_;
  std::uint64_t tick_ = 0;
};

/// Writes a log of so many whole trials.
inline void writeMadeRun(const std::string& path, int trials, const RunConfiguration& configuration = madeConfiguration()) {
  MadeRecording recording(path, configuration);
  for (int trial = 1; trial <= trials; ++trial) {
    recording.recorder.announce(trial, {trial - 1, 5 * trial, trial % 5 == 0});
    recording.until(static_cast<std::uint64_t>(trial) * MadeRun::kTicksPerTrial);
  }
  recording.recorder.close();
}

/// What `write` gives piece by piece of a run.
template <typename Write>
std::string textOf(const Write& write, const RunLog& run) {
  std::string text;
  write(run, [&](std::string_view piece) { text += piece; });
  return text;
}

/// The record of a trial without its place in the log.
inline std::string bytesOf(const RecordedTrial& trial) {
  ByteWriter out;
  RecordedTrial placeless = trial;
  placeless.offset = 0, placeless.sequence = 0;
  encode(placeless, {}, out);
  return {out.bytes().begin(), out.bytes().end()};
}

/// Copies a log, whose records `edit` may change, or leave out by false. A file of that name is replaced.
template <typename Edit>
void copyLog(const std::string& from, const std::string& to, Edit&& edit) {
  std::filesystem::remove(to);
  LogReader reader(from);
  LogWriter writer = LogWriter::create(to);
  for (RecordView record; reader.next(record);) {
    std::vector<std::uint8_t> payload(record.payload.begin(), record.payload.end());
    if (edit(record.type, payload)) writer.append(record.type, payload);
  }
}
/// Copies a log with another configuration.
inline void copyLogAs(const std::string& from, const std::string& to, const std::string& configuration) {
  copyLog(from, to, [&](RecordType type, std::vector<std::uint8_t>& payload) {
    if (type == RecordType::Configuration) payload.assign(configuration.begin(), configuration.end());
    return true;
  });
}

/// As a disk leaves it that took half of the record by which the last trial ends.
inline void cutInTheLastTrialsRecord(const std::string& path) {
  std::uint64_t last = 0;
  LogReader reader(path);
  for (RecordView record; reader.next(record);)
    if (record.type == RecordType::Trial) last = record.offset;
  std::filesystem::resize_file(path, last + 100);
}

}  // namespace reachlab::record
