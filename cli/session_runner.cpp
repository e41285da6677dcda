#include "cli/session_runner.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "cli/at_option.h"
#include "cli/stop_signals.h"
#include "cli/success_table.h"
#include "base/error.h"
#include "base/utc.h"
#include "devices/make_device.h"
#include "sim/haptics/run_conductor.h"
#include "sim/record/append_file.h"
#include "sim/record/bids.h"
#include "sim/record/recorder.h"

namespace reachlab::cli {
namespace {

std::string computerName() {
  utsname system{};
  ::uname(&system);
  return fmt::format("{} {} {}", system.sysname, system.release, system.machine);
}

void complete(record::RunConfiguration& configuration, const session::BlockToRun& block, const haptics::RunConductor& run, bool fast) {
  const haptics::DeviceInfo device = run.device();
  const haptics::TickEngine& engine = run.engine();
  configuration.deviceName = device.name;
  configuration.deviceVersion = device.version;
  configuration.deviceMaxForce = device.maxForce;
  configuration.virtualHand = device.virtualHand;
  configuration.rendersForce = device.rendersForce;
  configuration.deviceContinuousForce = device.maxContinuousForce;
  configuration.deviceThermalSeconds = device.thermalSeconds;
  configuration.method = engine.choice().method;
  configuration.methodReason = engine.choice().reason;
  configuration.softwareVersion = "reachlab " REACHLAB_VERSION;
  configuration.buildDescription = "g++ " __VERSION__;
  configuration.computer = computerName();
  configuration.startedUtc = utcText(std::chrono::system_clock::now());
  configuration.clock = fast ? "virtual" : "monotonic";
  configuration.table = record::makeChannelTable(block.experiment, engine.constraint().parameterCount());
}

// The pause between trials; the haptic loop goes on meanwhile.
void pauseFor(double seconds, const std::atomic<bool>& stopAsked) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!stopAsked && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

std::string describe(const haptics::LoopReport& report) {
  return fmt::format(
      "loop: {:.2f} ticks/s over {:.2f} s ({}); lateness p50 {:.1f} us, p99 {:.1f} us, max {:.1f} us; late {}, missed {}, "
      "longest gap {:.3f} "
      "ms; dropped {}, clamped {}",
      report.rate, report.seconds, report.mode, report.latenessP50, report.latenessP99, report.latenessMax, report.faults.lateTicks,
      report.faults.missedTicks, static_cast<double>(report.faults.longestGapNs) * 1e-6, report.faults.droppedRecords,
      report.faults.clampedTicks);
}

// True when it was done to its end.
bool runBlock(session::BlockToRun block, const session::SessionRequest& request, SuccessTable& table) {
  std::unique_ptr<record::Recorder> recorder;  // outlives the run
  haptics::RunConductor run(block.experiment, devices::makeDevice(request.device, block.experiment, block.configuration.seed), block.trials,
                            haptics::LoopOptions{.virtualClock = request.fast});
  if (request.fast && !run.device().virtualHand)
    throw UsageError(fmt::format("--fast: device {} moves in real time; allowed: simulated, replay", request.device));
  record::RunConfiguration configuration;
  atOption("--data", [&] {
    const session::FolderHold hold(request.place.data);
    session::takeFreeRun(block, request);
    configuration = block.configuration;
    complete(configuration, block, run, request.fast);
    recorder = std::make_unique<record::Recorder>(block.logPath, configuration,
                                                  record::RecorderOptions{.threaded = !request.fast, .diskReserve = request.diskReserve});
  });
  fmt::print(stderr, "run {}: {}, {} trial{}{}, method {}; recording to {}\n", configuration.run, configuration.condition,
             block.trials.size(), block.trials.size() == 1 ? "" : "s", configuration.practice ? " of practice" : "", configuration.method,
             block.logPath);
  cli::StopRequest stop;  // from here on a signal ends the trial, not the program
  run.start(recorder.get());
  bool interrupted = false;
  std::size_t conducted = 0;
  while (!interrupted) {
    const std::optional<haptics::ConductedTrial> trial = run.runTrial(stop.asked());
    if (!trial) break;
    fmt::print("{}\n", trialLine(recorder->lastTrial().trial, trial->result));
    std::fflush(stdout);
    table.add(configuration.condition + (trial->planned.catchTrial ? " (catch)" : ""), trial->result);
    interrupted = trial::endsRun(trial->result);
    const bool isRepeat = ++conducted > block.trials.size();
    if (trial::isPutUpAgain(trial->result) && configuration.repeatAborted && !isRepeat) run.append(trial->planned);
    if (!request.fast && run.trialsLeft() > 0) pauseFor(configuration.pauseSeconds, stop.asked());
    interrupted = interrupted || stop.asked();
  }
  if (!request.fast) {
    const std::string report = describe(run.report());
    recorder->note(report);
    fmt::print(stderr, "{}\n", report);
  }
  run.finish();
  stop.allInOrder();
  const record::RunLog log = record::RunLog::open(block.logPath);
  atOption("--data", [&] {
    record::writeBidsRun(log, request.place.data);
    const session::FolderHold hold(request.place.data);  // the tables are of all runs
    record::writeBidsTables({log.configuration()}, request.place.data);
  });
  return !interrupted;
}

}  // namespace

int runSession(const session::SessionRequest& request) {
  const session::SessionToRun session = session::planSession(request);
  if (!session.hint.empty()) fmt::print(stderr, "{}\n", session.hint);
  if (session.seedDrawn) fmt::print("seed={}\n", session.seed);
  if (session.blocks.empty()) fmt::print(stderr, "nothing is left to do: every trial of this session is recorded\n");
  std::fflush(stdout);
  record::removeLeftovers(request.place.data);
  SuccessTable table;
  bool done = true;
  for (const session::BlockToRun& block : session.blocks) {
    done = runBlock(block, request, table);
    if (!done) break;
  }
  fmt::print("{}", table.text());
  std::fflush(stdout);
  return done || cli::StopRequest::exitCode() == 0 ? 0 : cli::StopRequest::exitCode();
}

}  // namespace reachlab::cli
