#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

#include "base/fault.h"
#include "base/system/os.h"
#include "base/system/stop_signals.h"
#include "cli/commands/commands.h"
#include "cli/output/success_table.h"
#include "cli/output/trial_line.h"
#include "cli/terminal/session_device.h"
#include "network/station/observer.h"
#include "network/station/station_options.h"
#include "sim/session/recorded_session.h"

namespace reachlab::cli {
namespace {

constexpr auto kLook = std::chrono::milliseconds(2);

struct StationRequest {
  session::SessionRequest session;
  network::StationSetup setup;
  bool observes = false;
  double every = 1;  // [s] between two looks
};

/// One station from its first word to its last; every trial is armed as soon as it can be.
int conduct(session::SessionRequest request, const network::StationSetup& setup) {
  const session::Programme programme = session::readProgramme(request.what);
  request.device = withMappings(request);
  network::StationRun station(setup, session::experimentOfStations(programme));
  session::RecordedSession session(programme, request,
                                   [&station, make = checkedDeviceMaker()](const std::string& spec, auto scenes, std::uint64_t seed) {
                                     return make(spec, scenes, station.seedHere(seed));
                                   });
  session.prepareRuns([&station](session::RecordedRunOptions& options) { station.prepare(options); });
  session.openNext();
  session::RecordedRun& run = *session.run();
  const StopRequest stop;
  printWarnings(run);
  fmt::print(stderr, "run {}: station {}; recording to {}\n", run.configuration().run, station.station(), run.logPath());
  station.begin(run);
  SuccessTable table;
  std::string problem;
  for (network::StationNews news; !news.finished; std::this_thread::sleep_for(kLook)) {
    if (problem.empty() && !run.underWay()) problem = run.fault().value_or("");
    if (StopRequest::asked() || !problem.empty()) station.stop();
    if (station.isConductor() && station.isIdle()) {
      if (run.trialsLeft() == 0 || !problem.empty()) station.stop();
      station.armNext();
    }
    news = station.poll();
    for (const std::string& line : news.words) fmt::print(stderr, "{}\n", line);
    if (!news.notArmed.empty()) fmt::print(stderr, "not armed: {}\n", news.notArmed);
    if (!news.problem.empty()) problem = news.problem;
    if (!news.ended) continue;
    fmt::print("{}\n", trialLine(run.numberOf(*news.ended), news.ended->result));
    std::fflush(stdout);
    table.add(run.configuration().condition, news.ended->result);
  }
  fmt::print(stderr, "{}", station.close());
  session.closeRun();
  fmt::print("{}", table.text());
  if (!problem.empty()) throw ResourceError(problem);
  return StopRequest::exitCode();
}

/// Until the conductor's last word.
int watchStations(const StationRequest& request) {
  network::Observer observer(request.setup, session::experimentOfStations(session::readProgramme(request.session.what)));
  const StopRequest stop;
  const auto every = std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(request.every));
  auto shown = std::chrono::steady_clock::now();
  for (; !StopRequest::asked(); std::this_thread::sleep_for(kLook)) {
    const network::ObserverNews news = observer.poll();
    for (const network::LinkEvent& event : news.ended)
      fmt::print("station={} trial={} outcome={}{} apart_rms_m={:.6g}\n", event.station, event.trial, trial::nameOf(event.outcome),
                 event.reason == trial::Reason::None ? "" : fmt::format(" reason={}", trial::nameOf(event.reason)), event.apart);
    std::fflush(stdout);
    if (news.finished) return 0;
    if (!news.problem.empty()) throw ResourceError(news.problem);
    if (std::chrono::steady_clock::now() - shown < every) continue;
    fmt::print("{}", network::describeNewest(observer, static_cast<double>(os::now()) * 1e-9));
    std::fflush(stdout);
    shown = std::chrono::steady_clock::now();
  }
  return StopRequest::exitCode();
}

}  // namespace

void addStationCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("station", "One of several stations that move one object together");
  const auto r = std::make_shared<StationRequest>();
  session::SessionRequest& s = r->session;
  command->add_option("experiment", s.what, "Experiment with a hand for each station; the same at all of them")->required();
  auto* number = command->add_option("--number", r->setup.link.station, "Which of the experiment's hands is here, from 1")
                     ->check(CLI::Range(1, network::kMaxStations));
  auto* device = command->add_option("--device", s.device, "The device here; reach list devices tells all");
  network::addStationOptions(*command, r->setup);
  auto* observe =
      command
          ->add_flag("--observe,--look-on", r->observes, "Without a hand: prints what the stations do, and how trials end; records nothing")
          ->excludes(number)
          ->excludes(device)
          ->excludes(command->get_option("--conductor"));
  command->add_option("--every", r->every, "Seconds between two looks of an observer")
      ->check(CLI::Range(0.01, 3600.0))
      ->capture_default_str()
      ->needs(observe);
  command->add_option("--trials", s.trials, "Trials. The number of the conductor is used [default: 1]")
      ->check(CLI::Range(1, session::kMaxTrials));
  command->add_option("--subject", s.place.subject, "Subject's label, letters and digits [default: 01]");
  command->add_option("--session", s.place.session, "Session's label, letters and digits [default: 01]");
  command->add_option("--data", s.place.data, "Folder of the dataset, this station's own [default: ./data]");
  command->add_option("--seed", s.seed, "Seed of noise [default: one is drawn and stored]")
      ->check(CLI::Validator(session::seedFault, "SEED"));
  command->add_flag("--every-tick", s.everyTick, "Samples at 1 kHz instead of 100 Hz");
  command->footer(
      "Prints one line per trial, as reach run does. No trial is armed while a station is missing, differs in experiment or version, or has "
      "too\n"
      "poor a line (more than 120 ms round trip, nothing for more than 50 ms at a time): stderr says which, with the numbers.\n\n"
      "Examples, on one machine:\n"
      "  reach station chain-two-hands --number 1 --conductor --device simulated --insecure --interface lo --peer 127.0.0.1 --data left\n"
      "  reach station chain-two-hands --number 2 --device partner:follower --insecure --interface lo --peer 127.0.0.1 --data right\n"
      "  reach station chain-two-hands --observe --insecure --interface lo --peer 127.0.0.1");
  command->callback([r, number, device, &exitCode] {
    if (!r->observes && number->count() == 0)
      throw FaultError(Fault{"number", "is not told", "1 up, which of the experiment's hands is here; or --observe"});
    if (!r->observes && device->count() == 0)
      throw FaultError(Fault{"device", "is not told", "the device here (reach list devices); or --observe"});
    network::completeStationSetup(r->setup, r->session.device, "reach station");
    if (r->setup.insecure) fmt::print(stderr, "NOT ENCRYPTED: whoever is on this network can listen and join\n");
    if (!r->observes) {
      exitCode = conduct(r->session, r->setup);
      return;
    }
    exitCode = watchStations(*r);
  });
}

}  // namespace reachlab::cli
