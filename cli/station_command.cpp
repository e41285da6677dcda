#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <thread>

#include "base/fault.h"
#include "base/os.h"
#include "base/seeded.h"
#include "base/stop_signals.h"
#include "cli/commands.h"
#include "cli/helper_program.h"
#include "cli/seed_option.h"
#include "cli/success_table.h"
#include "devices/make_device.h"
#include "network/line/station_line.h"
#include "sim/dynamics/shared_plant.h"
#include "sim/session/recorded_run.h"

namespace reachlab::cli {
namespace {

constexpr auto kLook = std::chrono::milliseconds(2);

struct StationRequest {
  session::SessionRequest session;
  network::StationOptions station;
  bool insecure = false;
  double wait = 60;  // [s] for the other stations
  int rate = 1000;   // [1/s] at which its state is sent
  bool lookOn = false;
  double every = 1;  // [s] between two looks
};

/// One station from its first word to its last. The conductor arms trial after trial; the others put up what it arms.
class Station {
 public:
  explicit Station(const StationRequest& request)
      : request_(request), block_(session::planSession(request.session).blocks.at(0)), own_(request.station.station - 1) {
    const auto& experiment = block_.experiment.experiment();
    const int hands = static_cast<int>(experiment.hands.size());
    if (hands < 2)
      throw FaultError(Fault{"hands", fmt::format("are {}", std::max(hands, 1)), "an experiment with a hand for each station"});
    if (request_.station.station > hands)
      throw FaultError(Fault{"number", fmt::format("is {}, and the experiment has {} hands", request_.station.station, hands),
                             fmt::format("1 to {}", hands)});
    request_.station.stations = hands;
    line_ = std::make_unique<network::StationLine>(request_.station, network::sharedHash(experiment));
    session::RecordedRunOptions options;
    options.place = request_.session.place;
    options.diskReserve = request_.session.diskReserve;
    options.makeEngine = [this](const experiment::CompiledExperiment& e, const haptics::EngineOptions& engine) {
      network::CoupledCopy* copy = nullptr;
      auto made = network::makeStationEngine(e, own_, engine, copy);
      sink_ = std::make_unique<network::StationSink>(line_->memory(), *copy, own_, 1000 / request_.rate);
      watcher_.sink = sink_.get();
      return made;
    };
    options.watcher = &watcher_;
    auto device = devices::makeDevice(request_.session.device, block_.experiment,
                                      seededBits(block_.configuration.seed, static_cast<std::uint64_t>(own_)));
    run_ = std::make_unique<session::RecordedRun>(block_, std::move(device), options);
    run_->note(fmt::format("station {} of {}{}, {}", request_.station.station, hands, request_.station.conductor ? ", conductor" : "",
                           request_.insecure ? "not encrypted" : "encrypted"));
  }

  int conduct() {
    const StopRequest stop;
    fmt::print(stderr, "run {}: station {}; recording to {}\n", run_->configuration().run, request_.station.station, run_->logPath());
    const std::atomic<bool> never{false};
    run_->checkTiming(never);  // the loop runs from here on, and with it the line
    const bool done = request_.station.conductor ? lead() : follow();
    look();
    run_->note(fmt::format("network: {} bytes of states came twice or after newer ones and were dropped; {} samples found no room",
                           line_->memory().discardedBytes.load(), line_->memory().ringsFull.load()));
    run_->closeLog();
    fmt::print(stderr, "{}", line_->describe());
    if (const std::string fault = line_->finish(); !fault.empty()) fmt::print(stderr, "{}\n", fault);
    run_->finish();
    fmt::print("{}", table_.text());
    if (!problem_.empty()) throw ResourceError(problem_);
    return done ? 0 : StopRequest::exitCode();
  }

 private:
  /// The run asks for its watcher before the engine, and with it the sink, is made.
  struct Watcher final : haptics::RunSink {
    haptics::RunSink* sink = nullptr;
    bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missed) noexcept override {
      return sink->onTick(state, command, missed);
    }
    void announce(std::int32_t, const trial::PlannedTrial&) override {}
    void awaitTrial(std::int32_t) override {}
    void close() override {}
  };

  // Cards, and what the others sent into the log.
  void look() {
    line_->look();
    if (const std::vector<std::uint8_t> given = sink_->takeGiven(); !given.empty()) run_->recordPeers(given);
  }
  static double now() { return static_cast<double>(os::now()) * 1e-9; }

  // Waits until every line is good; false when it is asked to stop.
  bool awaitLines() {
    const double until = now() + request_.wait;
    std::string said;
    while (!StopRequest::asked()) {
      look();
      const std::vector<std::string> obstacles = line_->obstacles();
      std::string all;
      for (const std::string& one : obstacles) all += (all.empty() ? "" : "; ") + one;
      if (obstacles.empty()) return true;
      if (all != said) fmt::print(stderr, "not armed: {}\n", all), said = all;
      if (now() > until || !line_->endpointFault().empty()) {
        problem_ = "no trial was armed: " + all;
        return false;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

  void tellEnd(const haptics::ConductedTrial& trial) {
    network::LineEvent event;
    event.kind = network::EventKind::Ended;
    event.trial = trial.trial + trialsBefore_;
    event.outcome = trial.result.outcome;
    event.reason = trial.result.reason;
    event.apart = sink_->rmsApart();
    line_->send(event);
    run_->note(
        fmt::format("trial {}: copies apart {:.6g} m RMS, {:.6g} m at most; other hands' samples up to {:.6g} s old, held by less than "
                    "their full coupling for {} ticks; {} samples were no newer than one before",
                    run_->numberOf(trial), sink_->rmsApart(), sink_->mostApart(), sink_->oldest(), sink_->fadedTicks(), sink_->repeated()));
    fmt::print("{}\n", trialLine(run_->numberOf(trial), trial.result));
    std::fflush(stdout);
    table_.add(run_->configuration().condition, trial.result);
  }

  bool lead() {
    const double goodFor = 0.5;  // [s] the lines are heard before the first trial
    while (run_->trialsLeft() > 0) {
      if (!awaitLines()) return tellFinish(false);
      const double since = now();
      while (now() - since < goodFor && !StopRequest::asked()) std::this_thread::sleep_for(kLook);
      if (!awaitLines()) return tellFinish(false);
      network::LineEvent arm;
      arm.kind = network::EventKind::Arm;
      arm.planned = block_.trials.at(armed_);
      arm.trial = static_cast<std::int32_t>(++armed_);
      line_->send(arm);
      run_->putUpNext();
      const auto ended = awaitEnd();
      if (!ended) return tellFinish(false);
      awaitOthers(ended->trial);
      if (run_->fault()) {
        problem_ = *run_->fault();
        return tellFinish(false);
      }
    }
    return tellFinish(true);
  }

  bool tellFinish(bool done) {
    network::LineEvent event;
    event.kind = network::EventKind::Finish;
    line_->send(event);
    return done;
  }

  // The trial under way to its end, here.
  std::optional<haptics::ConductedTrial> awaitEnd() {
    bool asked = false;
    while (true) {
      look();
      if (const auto ended = run_->poll()) {
        tellEnd(*ended);
        if (asked) return std::nullopt;
        return ended;
      }
      takeEvents();
      if ((StopRequest::asked() || interrupted_) && !asked) {
        asked = true;
        if (request_.station.conductor) {
          network::LineEvent event;
          event.kind = network::EventKind::Interrupt;
          line_->send(event);
        }
        run_->abort();
      }
      std::this_thread::sleep_for(kLook);
    }
  }

  // Every station's word on this trial; who does not say it in time is named.
  void awaitOthers(std::int32_t trial) {
    constexpr double kPatience = 3;  // [s]
    const double until = now() + kPatience;
    const auto missing = [&] {
      std::string names;
      for (int i = 0; i < request_.station.stations; ++i)
        if (i != own_ && endedTrial_[static_cast<std::size_t>(i)] != trial) names += fmt::format("{}{}", names.empty() ? "" : ", ", i + 1);
      return names;
    };
    while (!missing().empty() && now() < until && !StopRequest::asked()) {
      takeEvents();
      look();
      std::this_thread::sleep_for(kLook);
    }
    if (const std::string silent = missing(); !silent.empty()) fmt::print(stderr, "no word on trial {} of station {}\n", trial, silent);
  }

  bool follow() {
    const double until = now() + request_.wait;
    bool begun = false;
    while (!StopRequest::asked()) {
      look();
      takeEvents();
      if (finished_) return true;
      if (armed_ < armAsked_) {
        if (!begun) {  // what was told before this station came: has that trial ended?
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
          takeEvents();
          if (armed_ == armAsked_) continue;
        }
        begun = true;
        armed_ = armAsked_;
        trialsBefore_ = static_cast<std::int32_t>(armAsked_) - ++putUp_;  // this station may have come back in mid-run
        sink_->countTrialsFrom(trialsBefore_);
        if (run_->trialsLeft() == 0) run_->repeat(planned_);
        run_->putUpNext();
        if (!awaitEnd()) return false;
      }
      if (const std::string fault = line_->endpointFault(); !fault.empty() || (!begun && now() > until)) {
        std::string why;
        for (const std::string& one : line_->obstacles()) why += "; " + one;
        problem_ = fault.empty() ? fmt::format("the conductor armed no trial within {:.0f} s{}", request_.wait, why) : fault;
        return false;
      }
      if (begun && line_->conductorSilence() > request_.wait) {
        problem_ = fmt::format("the conductor was not heard of for {:.0f} s", request_.wait);
        return false;
      }
      std::this_thread::sleep_for(kLook);
    }
    return false;
  }

  void takeEvents() {
    network::LineEvent event;
    while (line_->memory().eventsIn.tryPop(event)) {
      if (event.kind == network::EventKind::Arm && !request_.station.conductor) {
        armAsked_ = static_cast<std::size_t>(event.trial);
        planned_ = event.planned;
      }
      if (event.kind == network::EventKind::Interrupt) interrupted_ = true;
      if (event.kind == network::EventKind::Finish) finished_ = true;
      if (event.kind == network::EventKind::Ended) {
        endedTrial_.at(event.station - 1) = event.trial;
        if (!request_.station.conductor && static_cast<std::size_t>(std::max(event.trial, 0)) == armAsked_)
          armed_ = armAsked_;  // over without this one
        fmt::print(stderr, "station {}: trial {} {}{}{}, copies apart {:.3f} mm RMS\n", event.station, event.trial,
                   trial::nameOf(event.outcome), event.reason == trial::Reason::None ? "" : ", ",
                   event.reason == trial::Reason::None ? "" : trial::nameOf(event.reason), 1e3 * event.apart);
      }
    }
  }

  StationRequest request_;
  session::BlockToRun block_;
  int own_;
  std::unique_ptr<network::StationLine> line_;
  std::unique_ptr<network::StationSink> sink_;
  Watcher watcher_;
  SuccessTable table_;
  std::string problem_;
  std::size_t armed_ = 0, armAsked_ = 0;
  std::int32_t putUp_ = 0, trialsBefore_ = 0;
  trial::PlannedTrial planned_;
  bool finished_ = false, interrupted_ = false;
  std::array<std::int32_t, network::kMaxStations> endedTrial_{};
  std::unique_ptr<session::RecordedRun> run_;  // last: its loop ends before what it writes to
};

const char* wordOf(std::uint8_t phase) {
  constexpr std::array kWords{"idle", "waiting", "armed", "moving", "done"};
  return phase < kWords.size() ? kWords[phase] : "unknown";
}

/// Who only looks on: no hand, no copy, nothing recorded; the others do not know of it. Ends with the conductor's last word.
class LookerOn {
 public:
  explicit LookerOn(const StationRequest& request)
      : request_(request), block_(session::planSession(request.session).blocks.at(0)),
        plant_(dynamics::makeSharedPlant(block_.experiment.experiment(), block_.experiment.constraint())) {
    request_.station.station = 0;
    request_.station.stations = static_cast<int>(block_.experiment.experiment().hands.size());
    line_ = std::make_unique<network::StationLine>(request_.station, network::sharedHash(block_.experiment.experiment()));
  }

  int watch() {
    const StopRequest stop;
    const double begun = now();
    double shown = begun;
    bool heard = false;
    while (!StopRequest::asked()) {
      line_->look();
      take();
      if (finished_) return 0;
      heard = heard || std::any_of(newest_.begin(), newest_.end(), [](const network::HeardState& s) { return s.sample.sequence != 0; });
      if (const std::string fault = line_->endpointFault(); !fault.empty()) throw ResourceError(fault);
      if (!heard && now() - begun > request_.wait) throw ResourceError(fmt::format("no station was heard within {:.0f} s", request_.wait));
      if (now() - shown >= request_.every) show(), shown = now();
      std::this_thread::sleep_for(kLook);
    }
    return StopRequest::exitCode();
  }

 private:
  static double now() { return static_cast<double>(os::now()) * 1e-9; }

  void take() {
    network::LineMemory& memory = line_->memory();
    for (std::size_t i = 0; i < newest_.size(); ++i)
      while (memory.in[i].tryPop(newest_[i])) {}
    network::LineEvent event;
    while (memory.eventsIn.tryPop(event)) {
      if (event.kind == network::EventKind::Finish) finished_ = true;
      if (event.kind != network::EventKind::Ended) continue;
      fmt::print("station={} trial={} outcome={}{} apart_rms_m={:.6g}\n", event.station, event.trial, trial::nameOf(event.outcome),
                 event.reason == trial::Reason::None ? "" : fmt::format(" reason={}", trial::nameOf(event.reason)), event.apart);
      std::fflush(stdout);
    }
  }

  // Of every station the newest that came, and how far its copy was then from the first's.
  void show() {
    const auto count = static_cast<std::size_t>(plant_->placeCount());
    const network::CopySample* first = nullptr;
    for (std::size_t i = 0; i < newest_.size(); ++i) {
      const network::HeardState& state = newest_[i];
      if (state.sample.sequence == 0) continue;
      const network::CopySample& sample = state.sample;
      fmt::print("station={} trial={} phase={} age_s={:.3f} hand_m={:.5f},{:.5f},{:.5f} work_j={:.5f}", i + 1, state.trial,
                 wordOf(state.phase), now() - sample.time, sample.hand.x, sample.hand.y, sample.hand.z, sample.work);
      if (first != nullptr)
        fmt::print(" apart_m={:.6f}", plant_->distanceBetween({first->places.data(), count}, {sample.places.data(), count}));
      else first = &sample;
      fmt::print("\n");
    }
    std::fflush(stdout);
  }

  StationRequest request_;
  session::BlockToRun block_;
  std::unique_ptr<dynamics::SharedPlant> plant_;  // for distances
  std::unique_ptr<network::StationLine> line_;
  std::array<network::HeardState, network::kMaxStations> newest_{};
  bool finished_ = false;
};

std::string hostName() {
  char name[65] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "station";
}

}  // namespace

void addStationCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("station", "One of several stations that move one object together");
  const auto r = std::make_shared<StationRequest>();
  session::SessionRequest& s = r->session;
  network::StationOptions& station = r->station;
  command->add_option("experiment", s.what, "Experiment with a hand for each station; the same at all of them")->required();
  auto* number = command->add_option("--number", station.station, "Which of the experiment's hands is here, from 1")
                     ->check(CLI::Range(1, network::kMaxStations));
  auto* device = command->add_option("--device", s.device, "The device here; reach list devices tells all");
  auto* conductor = command->add_flag("--conductor", station.conductor, "Arms the trials and judges them for all; one station");
  auto* lookOn =
      command->add_flag("--look-on", r->lookOn, "Without a hand: prints what the stations do, and how trials end; records nothing")
          ->excludes(number)
          ->excludes(device)
          ->excludes(conductor);
  command->add_option("--every", r->every, "Seconds between two looks of who looks on")
      ->check(CLI::Range(0.01, 3600.0))
      ->capture_default_str()
      ->needs(lookOn);
  auto* peers = command->add_option("--peers", station.secure, "Folder of this station's certificates (reach peers)");
  command->add_flag("--insecure", r->insecure, "Without certificates and encryption: on a network of one's own")->excludes(peers);
  command->add_option("--name", station.name, "Name that the others see [the computer's]");
  command->add_option("--interface", station.interface, "Network interface [the system's choice]");
  command->add_option("--peer", station.peers, "Address of another station beyond this network; several times. No multicast then")
      ->allow_extra_args(false);
  command->add_option("--domain", station.domain, "Stations of one domain hear each other")
      ->check(CLI::Range(0, 230))
      ->capture_default_str();
  command->add_option("--wait", r->wait, "Seconds to wait for the others")->check(CLI::Range(1.0, 86400.0))->capture_default_str();
  command->add_option("--rate", r->rate, "How often a second this station's state is sent; less where the line or the computer is slow")
      ->check(CLI::IsMember({1000, 500, 250, 125}))
      ->capture_default_str();
  command->add_option("--trials", s.trials, "Trials [one]; the conductor's count holds")->check(CLI::Range(1, 1000000));
  command->add_option("--subject", s.place.subject, "Subject's label, letters and digits [01]");
  command->add_option("--session", s.place.session, "Session's label, letters and digits [01]");
  command->add_option("--data", s.place.data, "Folder of the dataset, this station's own [./data]");
  command->add_option("--seed", s.seed, "Seed of noise; default: one is drawn and stored")->check(wholeSeed());
  command->add_flag("--every-tick", s.everyTick, "Samples at 1 kHz instead of 100 Hz");
  command->footer(
      "Prints one line a trial, as reach run does. No trial is armed while a station is missing, differs in experiment or version, or has "
      "too\n"
      "poor a line (more than 120 ms round trip, nothing for more than 50 ms at a time): stderr says which, with the numbers.\n\n"
      "Examples, on one machine:\n"
      "  reach station chain-two-hands --number 1 --conductor --device simulated --insecure --interface lo --peer 127.0.0.1 --data left\n"
      "  reach station chain-two-hands --number 2 --device partner:follower --insecure --interface lo --peer 127.0.0.1 --data right\n"
      "  reach station chain-two-hands --look-on --insecure --interface lo --peer 127.0.0.1");
  command->callback([r, number, device, &exitCode] {
    if (!r->lookOn && number->count() == 0)
      throw FaultError(Fault{"number", "is not told", "1 up, which of the experiment's hands is here; or --look-on"});
    if (!r->lookOn && device->count() == 0)
      throw FaultError(Fault{"device", "is not told", "the device here (reach list devices); or --look-on"});
    if (r->lookOn) r->session.device = "simulated";  // of a plan that is never carried out
    if (!r->insecure && r->station.secure.empty())
      throw FaultError(Fault{"peers", "are not told", "--peers DIR with this station's certificates, or --insecure"});
    if (r->station.name.empty()) r->station.name = hostName();
    r->station.device = r->session.device;
    r->station.software = "reachlab " REACHLAB_VERSION;
    r->station.endpoint = findHelperProgram("reachlab-endpoint", "station", "the program that speaks to the network");
    if (r->insecure) fmt::print(stderr, "NOT ENCRYPTED: whoever is on this network can listen and join\n");
    if (r->lookOn) {
      LookerOn looker(*r);
      exitCode = looker.watch();
      return;
    }
    Station own(*r);
    exitCode = own.conduct();
  });
}

}  // namespace reachlab::cli
