#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/fault.h"
#include "base/system/stop_signals.h"
#include "base/terminal/message.h"
#include "cli/commands/commands.h"
#include "cli/output/success_table.h"
#include "cli/output/trial_line.h"
#include "cli/terminal/session_device.h"
#include "devices/hands/several_hands.h"
#include "devices/instruments/instruments.h"
#include "devices/kept_mapping.h"
#include "devices/make_device.h"
#include "sim/record/configuration/limits.h"
#include "sim/record/configuration/run_configuration.h"
#include "sim/session/backup_worker.h"
#include "sim/session/recorded_session.h"
#include "sim/trial/protocol.h"
#include "sim/trial/task_places.h"

namespace reachlab::cli {
namespace {

void printNotice(const session::SessionNotice& notice, const std::string& device) {
  if (!notice.deviceBefore.empty())
    fmt::print(stderr, "warning: this session was recorded with the device {}, and is resumed with {}; its trials may not be comparable\n",
               notice.deviceBefore, device);
  if (notice.unfinished)
    fmt::print(stderr, "note: an earlier run of this session is not finished. --resume continues it. This is a new run\n");
  if (notice.again)
    fmt::print(stderr,
               "warning: this session has blocks of this plan already, and they are recorded again; --resume continues after them\n");
  if (notice.nothingToResume)
    fmt::print(stderr, "warning: nothing that this session asks for is recorded yet, so there is nothing to resume. It begins\n");
  for (const std::string& sentence : notice.leftOut) fmt::print(stderr, "warning: {}\n", sentence);
}

void printRun(const session::RecordedRun& run) {
  const record::RunConfiguration& c = run.configuration();
  fmt::print(stderr, "run {}: {}, {} trial{}{}, method {}; recording to {}\n", c.run, c.condition, run.trialCount(),
             run.trialCount() == 1 ? "" : "s", c.practice ? " of practice" : "", c.method, run.logPath());
  printWarnings(run);
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

void requireMapping(const std::string& device) {
  const std::vector<std::string> hands = devices::splitHands(device);
  if (std::none_of(hands.begin(), hands.end(), [](const std::string& hand) { return devices::handSettingsOf(hand).mapped; }))
    throw FaultError(Fault{"--save-mapping", "the device has no mapping", "a device with scale=, offset=, rotation=, mirror= or mapping="});
}

void saveMappings(const session::SessionRequest& request) {
  for (const std::string& file : devices::keepMappings(request.device, request.place.data, request.place.subject))
    fmt::print(stderr, "mapping kept in {}\n", file);
}

// Conducts a session block by block. It prints one line per trial on stdout once the trial is safe on the disk. It writes the dataset at
// each block's end and the success table at the end. Returns the exit code: 0, or 130 after Ctrl-C (the trial under way is kept as
// interrupted). Throws the errors of planning, device, scene and disk. Finished trials are then on the disk.
int runSession(const session::SessionRequest& request, bool savesMapping) {
  const std::unique_ptr<record::InstrumentLink> instruments = devices::openInstruments(request.instruments);
  session::RecordedSession session(session::readProgramme(request.what), request, checkedDeviceMaker(), nullptr, instruments.get());
  printNotice(session.notice(), request.device);
  if (session.blocksLeft() == 0) fmt::print(stderr, "nothing is left to do: every trial of this session is recorded\n");
  std::fflush(stdout);
  SuccessTable table;
  std::optional<StopRequest> stop;
  session::SessionWords words;
  words.resting = [&](const session::BlockToRun& next) {
    stop.emplace();
    fmt::print("rest: {:g} s before the block {}\n", next.restSeconds, next.configuration.condition);
    std::fflush(stdout);
  };
  bool seedTold = !session.notice().seedDrawn;
  words.opened = [&](const session::RecordedRun& run) {
    if (!seedTold) fmt::print("seed={}\n", session.seed());
    seedTold = true;
    if (std::exchange(savesMapping, false)) saveMappings(request);
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
  if (backup && session.blocksLeft() == 0) backup->request();  // copies the runs that an earlier backup could not copy
  words.closed = [&] {
    stop.reset();
    if (backup) backup->request();
  };
  const bool done = session::conduct(session, StopRequest::asked(), words);
  stop.reset();
  fmt::print("{}", table.text());
  std::fflush(stdout);
  if (backup) {
    if (!done) fmt::print(stderr, "the finished runs are copied to {}; another Ctrl-C ends the copy\n", request.backup);
    const session::BackupState state = backup->finish();
    if (state.kind == session::BackupState::Kind::Failed) throw ResourceError(state.sentence);
    fmt::print(stderr, "{}\n", state.sentence);
  }
  return done ? 0 : StopRequest::exitCode();
}

}  // namespace

void addRunCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("run", "Records a run of an experiment, or a session of a plan");
  const auto r = std::make_shared<session::SessionRequest>();
  command->add_option("experiment", r->what, "Experiment or session plan: a file, or the name of a shipped one")->required();
  const auto hands = std::make_shared<std::vector<std::string>>();
  command
      ->add_option(
          "--device", *hands,
          "simulated[:KEY=VALUE,…], replay:FILE or replay:FOLDER, mouse …; `reach list devices` tells all. Once for each of the experiment's hands")
      ->required()
      ->allow_extra_args(false);
  command
      ->add_option("--instrument", r->instruments,
                   "lsl, parallel:PATH, rts:PATH or byte:PATH, told of go, onset and the end of a trial. May be given several times")
      ->expected(1)
      ->take_all();
  command
      ->add_option("--trials", r->trials,
                   "Trials of an experiment. A plan has its own [default: 1, or each file of a replayed folder once]")
      ->check(CLI::Range(1, session::kMaxTrials));
  command->add_option("--run", r->run, "Run number, above those that are taken [default: the next free one]")
      ->check(CLI::Range(1, record::kMaxRun));
  command->add_option("--subject", r->place.subject, "Label of the subject: letters and digits [default: 01]");
  command->add_option("--session", r->place.session,
                      "Label of the session: letters and digits. A number is the day of the plan [default: 01]");
  command->add_option("--data", r->place.data, "Folder of the dataset [default: ./data]");
  command->add_option("--backup", r->backup, "Second data folder: every finished run is copied there and verified");
  command->add_option("--seed", r->seed, "Seed of noise and order [default: one is drawn, printed and stored]")
      ->check(CLI::Validator(session::seedFault, "SEED"));
  command->add_flag("--fast", r->fast, "Virtual clock: as fast as the processor allows, the same results");
  command->add_flag("--resume", r->resume, "Continue with the trial at which this session broke off, in the same order");
  const auto saveMapping = std::make_shared<bool>(false);
  command->add_flag("--save-mapping", *saveMapping,
                    "Keeps the device's mapping (scale=, mirror=, …) for this device and subject in the dataset");
  command->add_flag("--every-tick", r->everyTick, "Samples at 1 kHz instead of 100 Hz");
  command
      ->add_option_function<double>(
          "--disk-reserve", [r](double megabytes) { r->diskReserve = static_cast<std::uint64_t>(megabytes * 1e6); },
          "MB that the recording leaves free on the disk [default: 1000, at most 5 % of the disk]")
      ->check(CLI::Range(0.0, 1e9));
  command
      ->add_option("--timing-check", r->timingCheckSeconds,
                   "Seconds for which the loop is watched before a block in real time. 0 skips the check [default: 2]")
      ->check(CLI::Range(0.0, 60.0));
  command->add_option("--day", r->day, "Day of the plan, when the session's label is no number")->check(CLI::Range(1, session::kMaxDay));
  command->add_option("--age", r->participant.age, "Participant's age [years]")->check(CLI::Range(0.0, record::kMaxAge));
  command->add_option("--sex", r->participant.sex, "Participant's sex: F, M or O")->check(CLI::IsMember({"F", "M", "O"}));
  command->add_option("--handedness", r->participant.handedness, "Participant's handedness: R, L or A")
      ->check(CLI::IsMember({"R", "L", "A"}));
  command->add_option("--notes", r->notes, "Notes by the experimenter; kept in the recording");
  for (const auto& [group, names] : std::initializer_list<std::pair<const char*, std::vector<const char*>>>{
           {"Device", {"--device", "--instrument", "--save-mapping", "--timing-check"}},
           {"Participant", {"--subject", "--age", "--sex", "--handedness", "--notes"}},
           {"Recording", {"--data", "--backup", "--every-tick", "--disk-reserve"}}})
    for (const char* const name : names) command->get_option(name)->group(group);
  command->footer(
      "Prints one line per trial once it is safe on the disk, `trial=3 outcome=failure reason=velocity mass=5 by=0.004 "
      "by_unit=m/s\n"
      "time_s=1.310`, and the success table at the end. The data folder is a BIDS dataset, its logs lie in sourcedata. Ctrl-C keeps "
      "the trial\n"
      "as interrupted and exits 130.\n\n"
      "Examples:\n"
      "  reach run chain-moderate --device simulated --trials 20 --seed 1 --fast\n"
      "  reach run chain-moderate --device replay:resources/reaches --fast\n"
      "  reach run chain-two-hands --device simulated --device partner:follower --trials 5 --seed 1 --fast\n"
      "  reach run paper --device simulated --subject 03 --session 01 --age 24 --sex F --handedness R --fast");
  command->callback([r, hands, saveMapping, &exitCode] {
    r->device = devices::joinHands(*hands);
    r->trialsOnOffer = devices::trialsOnOffer(r->device);
    if (*saveMapping) requireMapping(r->device);
    r->device = withMappings(*r);
    exitCode = runSession(*r, *saveMapping);
  });
}

}  // namespace reachlab::cli
