#include "cli/commands/session_runner.h"

#include <fmt/format.h>

#include <optional>

#include "base/system/stop_signals.h"
#include "base/terminal/message.h"
#include "cli/output/success_table.h"
#include "devices/instruments/instruments.h"
#include "devices/make_device.h"
#include "devices/preflight/preflight.h"
#include "sim/session/backup_worker.h"
#include "sim/session/recorded_session.h"
#include "sim/trial/protocol.h"
#include "sim/trial/task_places.h"

namespace reachlab::cli {
namespace {

void printNotice(const session::SessionNotice& notice) {
  if (notice.unfinished)
    fmt::print(stderr, "note: an earlier run of this session is not finished. --resume continues it. This is a new run\n");
  for (const std::string& sentence : notice.unreadable) fmt::print(stderr, "warning: {}\n", sentence);
}

void printRun(const session::RecordedRun& run) {
  const record::RunConfiguration& c = run.configuration();
  fmt::print(stderr, "run {}: {}, {} trial{}{}, method {}; recording to {}\n", c.run, c.condition, run.trialCount(),
             run.trialCount() == 1 ? "" : "s", c.practice ? " of practice" : "", c.method, run.logPath());
  for (const Fault& warning : trial::describeWay(run.experiment())) fmt::print(stderr, "{}", messageOf(warning, "warning"));
}

// Which hand is farthest from where it has to be.
void printWait(const session::RecordedRun& run) {
  const experiment::CompiledExperiment& experiment = run.experimentNow();
  const trial::ProtocolSettings place = trial::makeProtocolSettings(experiment.experiment(), experiment.constraint());
  const haptics::TickState& state = run.latest();
  const auto awayOf = [&](const haptics::HandState& hand) { return norm(hand.device.position - place.start); };
  const auto farthest = std::max_element(state.hands.begin(), state.hands.begin() + state.handCount,
                                         [&](const auto& a, const auto& b) { return awayOf(a) < awayOf(b); });
  const Vec3 hand = farthest->device.position;
  const double away = awayOf(*farthest);
  const std::string where = away > place.armRadius
                                ? fmt::format("{:.3g} m from there, at ({:.4f}, {:.4f}, {:.4f}) m", away, hand.x, hand.y, hand.z)
                                : "there, and does not rest";
  fmt::print(stderr, "the trial begins when the hand rests within {:g} m of ({:.4f}, {:.4f}, {:.4f}) m; it is {}\n", place.armRadius,
             place.start.x, place.start.y, place.start.z, where);
}

// Why a hand that no person moves never began.
void printNoStart(const session::RecordedRun& run) {
  printWait(run);
  const record::RunConfiguration& c = run.configuration();
  fmt::print(stderr, "{}; reach validate EXPERIMENT --device {} compares its workspace with the task\n",
             c.firstHand.mapping.empty() ? "the device is not mapped" : "its mapping is " + c.firstHand.mapping, c.device);
}

// Before anybody feels it: what this experiment will meet on this device.
std::unique_ptr<haptics::HapticDevice> makeCheckedDevice(const std::string& spec, std::span<const experiment::CompiledExperiment> scenes,
                                                         std::uint64_t seed, std::shared_ptr<void>& learnt) {
  auto device = devices::makeDevice(spec, scenes, seed, &learnt);
  for (const std::string& sentence : devices::warningsBeforeBlock(scenes, *device)) fmt::print(stderr, "warning: {}\n", sentence);
  return device;
}

}  // namespace

int runSession(const session::SessionRequest& request) {
  const std::unique_ptr<record::InstrumentLink> instruments = devices::openInstruments(request.instruments);
  std::shared_ptr<void> learnt;  // by a virtual person, from block to block
  const auto makeDevice = [&learnt](const std::string& spec, std::span<const experiment::CompiledExperiment> scenes, std::uint64_t seed) {
    return makeCheckedDevice(spec, scenes, seed, learnt);
  };
  session::RecordedSession session(session::readProgramme(request.what), request, makeDevice, nullptr, instruments.get());
  printNotice(session.notice());
  if (session.blocksLeft() == 0) fmt::print(stderr, "nothing is left to do: every trial of this session is recorded\n");
  std::fflush(stdout);
  SuccessTable table;
  std::optional<StopRequest> stop;
  session::SessionWords words;
  words.resting = [](const session::BlockToRun& next) {
    fmt::print("rest: {:g} s before the block {}\n", next.restSeconds, next.configuration.condition);
    std::fflush(stdout);
  };
  bool seedTold = !session.notice().seedDrawn;
  words.opened = [&](const session::RecordedRun& run) {
    if (!seedTold) fmt::print("seed={}\n", session.seed());
    seedTold = true;
    printRun(run);
    if (!run.instructions().empty()) fmt::print("{}\n", run.instructions());
    stop.emplace();  // from here on a signal ends the trial, not the program
  };
  words.checked = [](const session::RecordedRun& run) { fmt::print(stderr, "{}\n", run.timingVerdict()->sentence); };
  words.waiting = printWait;
  const auto warn = [&] {
    if (instruments == nullptr) return;
    for (const std::string& sentence : instruments->takeWarnings()) fmt::print(stderr, "warning: {}\n", sentence);
  };
  words.ended = [&](const session::RecordedRun& run, const haptics::ConductedTrial& trial) {
    warn();
    fmt::print("{}\n", trialLine(run.numberOf(trial), trial.result, record::sceneOf(run.configuration(), trial.planned)));
    std::fflush(stdout);
    if (trial.result.reason == trial::Reason::NoStart) printNoStart(run);
    table.add(record::conditionOf(run.configuration(), trial.planned) + (trial.planned.catchTrial ? " (catch)" : ""), trial.result);
  };
  words.logClosed = [&](const session::RecordedRun& run) {
    warn();
    if (!run.timing().empty()) fmt::print(stderr, "{}\n", run.timing());
    stop->allInOrder();
  };
  std::optional<session::BackupWorker> backup;
  if (!request.backup.empty()) backup.emplace(request.place.data, request.backup);
  words.closed = [&](const session::RecordedRun&) {
    stop.reset();
    if (backup) backup->request();
  };
  const bool done = session::conduct(session, StopRequest::asked(), words);
  fmt::print("{}", table.text());
  std::fflush(stdout);
  if (backup) {
    backup->request();  // the last log is let go of only now
    const session::BackupState state = backup->finish();
    if (state.kind == session::BackupState::Kind::Failed) throw ResourceError(state.sentence);
    fmt::print(stderr, "{}\n", state.sentence);
  }
  return done ? 0 : StopRequest::exitCode();
}

}  // namespace reachlab::cli
