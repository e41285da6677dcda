#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/fault.h"
#include "cli/commands/commands.h"
#include "cli/commands/session_runner.h"
#include "cli/terminal/seed_option.h"
#include "devices/hands/several_hands.h"
#include "devices/kept_mapping.h"
#include "devices/make_device.h"
#include "sim/record/configuration/limits.h"
#include "sim/record/configuration/run_configuration.h"

namespace reachlab::cli {
namespace {

// The device as it was asked for, with the mappings that are kept for this subject where none was asked for.
std::string withMappings(const std::string& device, const session::SessionRequest& request, bool save) {
  const std::string& subject = request.place.subject;
  if (record::labelFault(subject, "subject")) return device;  // refused by the run, in its own words
  if (save) {
    const auto kept = devices::keepMappings(device, request.place.data, subject);
    if (kept.empty())
      throw FaultError(
          Fault{"--save-mapping", "the device has no mapping", "a device with scale=, offset=, rotation=, mirror= or mapping="});
    for (const std::string& file : kept) fmt::print(stderr, "mapping kept in {}\n", file);
  }
  std::vector<std::string> taken;
  std::string mapped = devices::withKeptMappings(device, request.place.data, subject, taken);
  for (const std::string& file : taken) fmt::print(stderr, "mapping of {}\n", file);
  return mapped;
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
      ->check(CLI::Range(1, 1000000));
  command->add_option("--run", r->run, "Run number. A taken one is refused [default: the next free one]")
      ->check(CLI::Range(1, record::kMaxRun));
  command->add_option("--subject", r->place.subject, "Label of the subject: letters and digits [default: 01]");
  command->add_option("--session", r->place.session,
                      "Label of the session: letters and digits. A number is the day of the plan [default: 01]");
  command->add_option("--data", r->place.data, "Folder of the dataset [default: ./data]");
  command->add_option("--backup", r->backup, "Second data folder: every finished run is copied there and verified");
  command->add_option("--seed", r->seed, "Seed of noise and order [default: one is drawn, printed and stored]")->check(wholeSeed());
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
  command->add_option("--day", r->day, "Day of the plan, when the session's label is no number")->check(CLI::Range(1, 10000));
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
    r->trialsOnOffer = devices::trialsOnOffer(devices::joinHands(*hands));
    r->device = withMappings(devices::joinHands(*hands), *r, *saveMapping);
    exitCode = runSession(*r);
  });
}

}  // namespace reachlab::cli
