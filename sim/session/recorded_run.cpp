#include "sim/session/recorded_run.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <thread>
#include <utility>

#include "base/system/os.h"
#include "base/system/processor_level.h"
#include "base/system/utc.h"
#include "constraints/constraint.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/exporters.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/folder_hold.h"

namespace reachlab::session {
namespace {

constexpr auto kLook = std::chrono::milliseconds(2);
constexpr int kLooks = 50;            // the loop takes a command within a tick
constexpr double kCheckPatience = 1;  // [s] for a loop that does not keep up with the clock at all

std::string computerName() {
  utsname system{};
  ::uname(&system);
  return fmt::format("{} {} {}", system.sysname, system.release, system.machine);
}

std::string describe(const haptics::LoopReport& report) {
  return fmt::format(
      "loop: {:.2f} ticks/s over {:.2f} s ({}); lateness p50 {:.1f} us, p99 {:.1f} us, max {:.1f} us; late {}, missed {}, "
      "longest gap {:.3f} ms; dropped {}, clamped {}",
      report.rate, report.seconds, report.mode, report.latenessP50, report.latenessP99, report.latenessMax, report.faults.lateTicks,
      report.faults.missedTicks, static_cast<double>(report.faults.longestGapNs) * 1e-6, report.faults.droppedRecords,
      report.faults.clampedTicks);
}

/// What writes into the dataset; a fault of the disk is then known to be one of that folder.
template <class Work>
void inDataset(Work&& work) {
  try {
    work();
  } catch (const ResourceError& fault) {
    throw DatasetError(fault.what());
  }
}

/// Ticks go to the recorder, which may count one as lost, and to who sees them as well.
class WatchedSink final : public haptics::RunSink {
 public:
  WatchedSink(haptics::RunSink& recorder, std::vector<haptics::RunSink*> watchers) : recorder_(recorder), watchers_(std::move(watchers)) {}
  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept override {
    for (haptics::RunSink* watcher : watchers_) watcher->onTick(state, command, missedTicks);
    return recorder_.onTick(state, command, missedTicks);
  }
  std::uint32_t massesEvery() const noexcept override {
    std::uint32_t every = recorder_.massesEvery();
    for (const haptics::RunSink* watcher : watchers_) every = std::gcd(every, watcher->massesEvery());
    return every;
  }
  void announce(std::int32_t trial, const trial::PlannedTrial& planned) override {
    recorder_.announce(trial, planned);
    for (haptics::RunSink* watcher : watchers_) watcher->announce(trial, planned);
  }
  void awaitTrial(std::int32_t trial) override { recorder_.awaitTrial(trial); }
  void close() override { recorder_.close(); }

 private:
  haptics::RunSink& recorder_;
  std::vector<haptics::RunSink*> watchers_;
};

}  // namespace

RecordedRun::RecordedRun(BlockToRun block, std::unique_ptr<haptics::HapticDevice> device, const RecordedRunOptions& options)
    : block_(std::move(block)), options_(options), trialCount_(block_.trials.size()) {
  if (options.virtualClock && !device->info().virtualHand)
    throw FaultError(Fault{"fast", fmt::format("device {} moves in real time", block_.configuration.device), "simulated, replay"});
  if (options.virtualClock && options.instruments != nullptr)
    throw FaultError(Fault{"fast", "there are instruments, which are on the real clock", "either of them"});
  const haptics::LoopOptions loop{.virtualClock = options.virtualClock, .clock = options.clock};
  const haptics::EngineOptions hands = haptics::engineOptions(*device);
  auto engine =
      options.makeEngine ? options.makeEngine(block_.experiment, hands) : std::make_unique<haptics::TickEngine>(block_.scenes, hands);
  conductor_ = std::make_unique<haptics::RunConductor>(std::move(engine), std::move(device), block_.trials, loop);
  choice_ = conductor_->engine().choice();
  inDataset([this] { openLog(); });
}

std::vector<Fault> RecordedRun::warnings() const {
  std::vector<Fault> warnings;
  for (std::size_t i = 0; i < block_.scenes.size(); ++i)
    for (Fault& warning : warningsOf(block_.scenes[i], conductor_->engine().choice(i)))
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(std::move(warning));
  return warnings;
}

RecordedRun::~RecordedRun() {
  try {
    finish();
  } catch (const std::exception&) {  // the disk is gone: that was said when the trial ended, and nothing can be said here
  }
}

void RecordedRun::completeConfiguration() {
  record::RunConfiguration& c = block_.configuration;
  const std::vector<haptics::DeviceInfo> hands = conductor_->hands();
  c.firstHand = conductor_->device();
  c.timing = block_.experiment.experiment().timing;
  c.otherHands.assign(hands.begin() + 1, hands.end());
  if (const auto& task = block_.experiment.experiment().task) c.rest = task->rest;
  c.instruments.clear();  // a run that is resumed has its own
  if (options_.instruments != nullptr) c.instruments = options_.instruments->names();
  c.method = choice_.method;
  c.methodReason = choice_.reason;
  for (std::size_t i = 0; c.scenes && i < c.scenes->size(); ++i) {
    const dynamics::MethodChoice& choice = conductor_->engine().choice(i);
    c.scenes->at(i).method = choice.method;
    c.scenes->at(i).methodReason = choice.reason;
  }
  c.softwareVersion = "reachlab " REACHLAB_VERSION;
  c.buildDescription = std::string("g++ " __VERSION__ ", for ") + processorLevel();
  c.computer = computerName();
  c.startedUtc = utcText(std::chrono::system_clock::now());
  c.clock = options_.virtualClock ? "virtual" : "monotonic";
  experiment::Experiment recorded = record::channelsOfAll(block_.scenes);
  if (c.otherHands.empty()) recorded.hands.clear();  // a station records its own hand alone
  c.table = record::makeChannelTable(recorded, block_.experiment.constraint().parameterCount(), c.firstHand.rendersForce);
  c.table.channels.insert(c.table.channels.end(), options_.furtherChannels.begin(), options_.furtherChannels.end());
}

// The number is free when the log is created: nobody else takes one meanwhile.
void RecordedRun::openLog() {
  const record::FolderHold hold = holdDataset(options_.place.data);
  record::removeLeftovers(options_.place.data);
  takeFreeRun(block_, options_.place, options_.numberAskedFor);
  completeConfiguration();
  recorder_ = std::make_unique<record::Recorder>(
      block_.logPath, block_.configuration,
      record::RecorderOptions{.threaded = !options_.virtualClock, .diskReserve = options_.diskReserve, .further = options_.further});
}

// A repeat is not repeated. The instruments' events are of the trial, and of the time before it.
void RecordedRun::takeEnded(const haptics::ConductedTrial& trial) {
  const bool isRepeat = ++conducted_ > block_.trials.size() - block_.repeats;
  if (block_.configuration.repeatAborted && trial::isPutUpAgain(trial.result) && !isRepeat) repeat(trial.planned);
  if (options_.instruments == nullptr) return;
  options_.instruments->awaitTrial(0);
  recorder_->add(options_.instruments->takeEvents());
}

void RecordedRun::start() {
  if (std::exchange(started_, true)) return;
  std::vector<haptics::RunSink*> watchers = options_.watchers;
  if (options_.instruments != nullptr) {
    options_.instruments->begin(block_.configuration);
    watchers.push_back(options_.instruments);
  }
  if (!watchers.empty()) sink_ = std::make_unique<WatchedSink>(*recorder_, std::move(watchers));
  conductor_->start(sink_ ? sink_.get() : recorder_.get());
  checkUntilNs_ = os::now() + std::llround((options_.timingCheckSeconds + kCheckPatience) * 1e9);
}

// True as long as the loop is watched; the verdict is there afterwards. By the loop's clock, or by ours where the loop does not come to it.
bool RecordedRun::checksTiming() {
  if (timingVerdict_ || options_.virtualClock || !(options_.timingCheckSeconds > 0)) return false;
  const haptics::LoopReport report = conductor_->report();
  if (report.seconds < options_.timingCheckSeconds && os::now() < checkUntilNs_ && !conductor_->fault()) return true;
  timingVerdict_ = haptics::judgeTiming(report, conductor_->engine().protocol());
  note(timingVerdict_->sentence);
  return false;
}

void RecordedRun::checkTiming(const std::atomic<bool>& stop) {
  start();
  while (!stop && checksTiming()) {
    (void)conductor_->poll();  // throws when the device hangs
    std::this_thread::sleep_for(kLook);
  }
}

bool RecordedRun::putUpNext() {
  start();
  if (underWay()) return false;
  if (!checksTiming()) return conductor_->putUpNext();
  return awaited_ = trialsLeft() > 0;
}

std::optional<haptics::ConductedTrial> RecordedRun::poll() {
  if (!started_) return std::nullopt;
  if (awaited_ && !checksTiming()) {
    awaited_ = false;
    (void)conductor_->putUpNext();
  }
  const std::optional<haptics::ConductedTrial> trial = conductor_->poll();
  if (trial) takeEnded(*trial);
  return trial;
}

std::optional<haptics::ConductedTrial> RecordedRun::runTrial(const std::atomic<bool>& stop, const std::function<void()>& looked) {
  checkTiming(stop);
  if (stop) return std::nullopt;  // else a trial that nobody saw would be recorded
  const std::optional<haptics::ConductedTrial> trial = conductor_->runTrial(stop, looked);
  if (trial) takeEnded(*trial);
  return trial;
}

void RecordedRun::repeat(const trial::PlannedTrial& trial) {
  conductor_->append(trial);
  ++trialCount_;
}

bool RecordedRun::takeBackRepeat() {
  if (!conductor_->takeBackAppended()) return false;
  --trialCount_;
  return true;
}

void RecordedRun::abort() {
  if (awaited_) {  // who aborts does not wait for the check: the trial is put up, and aborted
    awaited_ = false;
    if (!conductor_->putUpNext()) return;
  }
  if (underWay()) conductor_->abort();
}

void RecordedRun::closeLog() {
  if (std::exchange(closed_, true)) return;
  awaited_ = false;  // never put up
  if (conductor_->underWay()) {
    conductor_->interrupt();
    if (options_.virtualClock) (void)conductor_->poll();
    // In real time by the recorder's word: a window that shows the newest state meanwhile is not disturbed, and a device that hangs is no fault here.
    const int trial = block_.configuration.firstTrial + static_cast<int>(conducted_);
    for (int looks = 0; looks < kLooks && !options_.virtualClock && recorder_->lastTrial().trial < trial; ++looks)
      std::this_thread::sleep_for(kLook);
  }
  if (started_ && !options_.virtualClock) {
    timing_ = describe(report());
    note(timing_);
  }
  if (started_ && options_.instruments != nullptr) {
    options_.instruments->close();
    recorder_->add(options_.instruments->takeEvents());
  }
  conductor_->finish();
  recorder_->close();
}

void RecordedRun::finish() {
  closeLog();
  if (std::exchange(finished_, true)) return;
  inDataset([this] {
    const std::vector<record::RunLog> run{record::RunLog::open(block_.logPath)};
    const record::FolderHold hold = holdDataset(options_.place.data);  // the tables are of all runs
    for (const record::Exporter& exporter : record::exporters())
      if (exporter.withEachRun) record::writeInto(options_.place.data, exporter, run);
  });
}

}  // namespace reachlab::session
