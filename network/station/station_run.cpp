#include "network/station/station_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "base/fault.h"
#include "base/math/seeded.h"
#include "base/system/os.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {
namespace {

constexpr double kGoodFor = 0.5;  // [s] the lines are heard before a trial
constexpr double kPatience = 3;   // [s] for every station's word on a trial
// share and [s] by which a round trip may become longer until it is simulated again
constexpr double kLongerTrip = 0.25, kLongerBy = 0.005;
constexpr double kOldWords = 0.05;      // [s] in which it is known whether a trial told of has ended already
constexpr std::size_t kMostHeard = 64;  // events of stations that do not say who they are

double now() { return static_cast<double>(os::now()) * 1e-9; }

std::string joined(const std::vector<std::string>& sentences) {
  std::string all;
  for (const std::string& one : sentences) all += (all.empty() ? "" : "; ") + one;
  return all;
}

StationSetup forExperiment(StationSetup setup, const experiment::Experiment& experiment) {
  const int hands = static_cast<int>(experiment.hands.size());
  if (hands < 2) throw FaultError(Fault{"hands", fmt::format("are {}", std::max(hands, 1)), "an experiment with a hand for each station"});
  if (setup.line.station > hands)
    throw FaultError(
        Fault{"number", fmt::format("is {}, and the experiment has {} hands", setup.line.station, hands), fmt::format("1 to {}", hands)});
  setup.line.stations = hands;
  return setup;
}

// Lines between two others are not known here: they are taken to be as bad.
MeasuredLine worstLine(const StationLine& line) {
  MeasuredLine worst;
  for (const StationStanding& other : line.standings()) worst = MeasuredLine::worse(worst, {other.roundTrip, other.jitter, other.loss});
  return worst;
}

std::string wordsOf(trial::Outcome outcome, trial::Reason reason) {
  return std::string(trial::nameOf(outcome)) + (reason == trial::Reason::None ? "" : fmt::format(" ({})", trial::nameOf(reason)));
}

}  // namespace

std::string wordsOf(const LineEvent& ended) {
  return fmt::format("station {}: trial {} {}, copies apart {:.3f} mm RMS", ended.station, ended.trial,
                     wordsOf(ended.outcome, ended.reason), 1e3 * ended.apart);
}

StationRun::StationRun(const StationSetup& setup, const experiment::CompiledExperiment& experiment)
    : setup_(forExperiment(setup, experiment.experiment())), own_(setup.line.station - 1), experiment_(experiment.experiment()),
      line_(std::make_unique<StationLine>(setup_.line, sharedHash(experiment.experiment()))), until_(now() + setup.wait) {}

StationRun::~StationRun() { closing_.request_stop(); }

void StationRun::prepare(session::RecordedRunOptions& options) {
  options.makeEngine = [this](const experiment::CompiledExperiment& e, const haptics::EngineOptions& engine) {
    CoupledCopy* copy = nullptr;
    auto made = makeStationEngine(e, own_, engine, copy);
    sink_ = std::make_unique<StationSink>(line_->memory(), *copy, own_, 1000 / setup_.rate);
    watcher_.sink = sink_.get();
    return made;
  };
  options.watchers.push_back(&watcher_);
  options.furtherChannels = lineChannels(setup_.line.station, setup_.line.stations);
  options.further = &watcher_;
  options.timingCheckSeconds = 0;  // a trial is put up when the others put it up
}

void StationRun::begin(session::RecordedRun& run) {
  run_ = &run;
  run.note(fmt::format("station {} of {}{}, {}", setup_.line.station, setup_.line.stations, setup_.line.conductor ? ", conductor" : "",
                       setup_.insecure ? "not encrypted" : "encrypted"));
  const std::atomic<bool> never{false};
  run.checkTiming(never);  // nothing to check: the loop runs from here on
}

std::uint64_t StationRun::seedHere(std::uint64_t seed) const { return seededBits(seed, static_cast<std::uint64_t>(own_)); }

void StationRun::armNext() { wanted_ = isConductor() && !stopping_; }

void StationRun::abort() {
  if (isArming()) wanted_ = false, stage_ = Stage::Idle;
  if (stage_ != Stage::UnderWay || aborted_) return;
  aborted_ = true;
  if (isConductor()) tell(EventKind::Interrupt);
  run_->abort();
}

void StationRun::stop() {
  stopping_ = true;
  abort();
}

void StationRun::keep() {
  line_->look();
  if (run_ == nullptr || closed_) return;
  if (const std::vector<std::uint8_t> given = sink_->takeGiven(); !given.empty()) run_->recordPeers(given);
  if (const OtherHands* hands = sink_->takeOtherHands()) others_ = *hands;
}

StationNews StationRun::poll() {
  StationNews news;
  keep();
  news.ended = run_->poll();
  if (news.ended) tellEnd(*news.ended);
  takeEvents(news);
  keepVerdict(news);
  if (isConductor()) lead(news);
  else follow(news);
  if (stopping_ && stage_ != Stage::UnderWay) {
    if (isConductor() && !finishTold_) tell(EventKind::Finish);
    finished_ = true;
  }
  if (finished_ && stage_ != Stage::UnderWay) stage_ = Stage::Over, news.finished = true;
  return news;
}

void StationRun::lead(StationNews& news) {
  switch (stage_) {
    case Stage::Over: return;
    case Stage::Idle:
      if (!wanted_) return;
      wanted_ = false;
      stage_ = Stage::Lines;
      until_ = now() + setup_.wait;
      said_.clear();
      [[fallthrough]];
    case Stage::Lines:
    case Stage::LinesAgain: return awaitLines(news);
    case Stage::Settling:
      if (now() >= until_) stage_ = Stage::LinesAgain, until_ = now() + setup_.wait;
      return;
    case Stage::Checking: return awaitCheck(news);
    case Stage::UnderWay:
      if (news.ended) stage_ = Stage::Others, until_ = now() + kPatience;
      return;
    case Stage::Others:
      if (const std::string silent = silentOnes(); silent.empty()) stage_ = Stage::Idle;
      else if (now() >= until_ || stopping_) {
        news.words.push_back(fmt::format("no word on trial {} of station {}", armed_, silent));
        stage_ = Stage::Idle;
      }
  }
}

bool StationRun::isChecked() const {
  const double trip = worstLine(*line_).roundTrip;
  return frequency_ > 0 && trip <= checkedFor_.roundTrip * (1 + kLongerTrip) + kLongerBy;
}

// Before the first trial, and when a line has become much longer. The simulation takes a tenth of a second or several; nobody waits for it.
void StationRun::check() {
  stage_ = Stage::Checking;
  if (checking_.valid()) return;  // asked for before a trial that was taken back
  checkedFor_ = worstLine(*line_);
  checking_ = std::async(std::launch::async, [experiment = experiment_, line = checkedFor_, stop = closing_.get_token()] {
    return checkLine(experiment, line, stop);
  });
}

void StationRun::awaitCheck(StationNews& news) {
  if (checking_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const LineCheck found = checking_.get();
  run_->note(found.sentence);
  if (!found.stable) {
    stage_ = Stage::Idle;
    frequency_ = 0;
    return inVain("no trial was armed: " + found.sentence, news);
  }
  if (found.frequency > copySettingsFor(experiment_).frequency) news.words.push_back(found.sentence);
  frequency_ = std::max(frequency_, found.frequency);
  stage_ = Stage::LinesAgain;
  until_ = now() + setup_.wait;
}

// Twice good, and time between: the lines are heard before a trial.
void StationRun::awaitLines(StationNews& news) {
  const std::vector<std::string> obstacles = line_->obstacles();
  if (obstacles.empty()) {
    if (stage_ == Stage::LinesAgain) return isChecked() ? putUp(news) : check();
    stage_ = Stage::Settling;
    until_ = now() + kGoodFor;
    return;
  }
  const std::string all = joined(obstacles);
  if (all != said_) news.notArmed = said_ = all;
  if (now() <= until_ && line_->endpointFault().empty()) return;
  stage_ = Stage::Idle;
  inVain("no trial was armed: " + all, news);
}

void StationRun::putUp(StationNews& news) {
  if (isConductor()) {
    const trial::PlannedTrial* next = run_->nextPlanned();
    if (next == nullptr) {
      stage_ = Stage::Idle;
      return;
    }
    LineEvent arm;
    arm.kind = EventKind::Arm;
    arm.planned = *next;
    arm.trial = ++armed_;
    arm.frequency = frequency_;
    line_->send(arm);
  } else {
    armed_ = armAsked_;
    trialsBefore_ = armAsked_ - ++putUp_;  // this station may have come back in mid-run
    sink_->countTrialsFrom(trialsBefore_);
    if (run_->trialsLeft() == 0) run_->repeat(planned_);
  }
  sink_->synchroniseBy(frequency_);
  aborted_ = false;
  ended_.reset();
  (void)run_->putUpNext();
  stage_ = Stage::UnderWay;
  news.begun = true;
}

void StationRun::follow(StationNews& news) {
  if (stage_ == Stage::UnderWay && news.ended) stage_ = Stage::Idle;
  if (stage_ != Stage::Idle || finished_ || stopping_) return;
  if (std::find(endedTrial_.begin(), endedTrial_.end(), armAsked_) != endedTrial_.end()) armed_ = armAsked_;  // over without this one
  if (armed_ < armAsked_) {
    // What was told before this station came: has that trial ended?
    if (!begun_ && settled_ == 0) settled_ = now() + kOldWords;
    if (begun_ || now() >= settled_) {
      begun_ = true;
      return putUp(news);
    }
  } else {
    settled_ = 0;
  }
  if (const std::string fault = line_->endpointFault(); !fault.empty()) return inVain(fault, news);
  if (!begun_ && now() > until_) {
    std::string why;
    for (const std::string& one : line_->obstacles()) why += "; " + one;
    return inVain(fmt::format("the conductor armed no trial within {:.0f} s{}", setup_.wait, why), news);
  }
  if (begun_ && line_->conductorSilence() > setup_.wait)
    inVain(fmt::format("the conductor was not heard of for {:.0f} s", setup_.wait), news);
}

// Not at every look again.
void StationRun::inVain(const std::string& what, StationNews& news) {
  if (what == said_ && now() <= until_) return;
  said_ = what;
  until_ = now() + setup_.wait;
  news.problem = what;
}

void StationRun::tell(EventKind kind) {
  LineEvent event;
  event.kind = kind;
  event.trial = armed_;
  if (kind == EventKind::Finish) finishTold_ = true;
  line_->send(event);
}

void StationRun::tellEnd(const haptics::ConductedTrial& trial) {
  LineEvent event;
  event.kind = EventKind::Ended;
  event.trial = trial.trial + trialsBefore_;
  event.outcome = trial.result.outcome;
  event.reason = trial.result.reason;
  event.apart = sink_->rmsApart();
  line_->send(event);
  ended_ = trial;
  if (isConductor()) event.station = static_cast<std::uint32_t>(setup_.line.station), verdict_ = event;
  run_->note(
      fmt::format("trial {}: copies apart {:.6g} m RMS, {:.6g} m at most; other hands' samples up to {:.6g} s old, held by less than "
                  "their full coupling for {} ticks; {} samples were no newer than one before",
                  run_->numberOf(trial), sink_->rmsApart(), sink_->mostApart(), sink_->oldest(), sink_->fadedTicks(), sink_->repeated()));
}

// The conductor's copy is judged for all; each station keeps that beside what its own copy came to, and how far apart the two were then.
void StationRun::keepVerdict(StationNews& news) {
  if (!ended_ || !verdict_ || verdict_->trial != ended_->trial + trialsBefore_) return;
  const std::string judged = wordsOf(verdict_->outcome, verdict_->reason), here = wordsOf(ended_->result.outcome, ended_->result.reason);
  run_->note(fmt::format("trial {}: outcome {} by the conductor, station {}; {} here, where the copies were {:.6g} m apart at its end",
                         run_->numberOf(*ended_), judged, verdict_->station, here, sink_->lastApart()));
  if (verdict_->outcome != ended_->result.outcome)
    news.words.push_back(
        fmt::format("trial {}: {} by the conductor's copy, which counts; {} by the copy here", verdict_->trial, judged, here));
  ended_.reset();
}

std::string StationRun::silentOnes() const {
  std::string names;
  for (int i = 0; i < setup_.line.stations; ++i)
    if (i != own_ && endedTrial_[static_cast<std::size_t>(i)] != armed_) names += fmt::format("{}{}", names.empty() ? "" : ", ", i + 1);
  return names;
}

void StationRun::takeEvents(StationNews& news) {
  LineEvent event;
  while (line_->memory().eventsIn.tryPop(event))
    if (heard_.size() < kMostHeard) heard_.push_back(event);
  for (std::size_t left = heard_.size(); left > 0; --left) {
    event = heard_.front();
    heard_.pop_front();
    if (event.station < 1 || event.station > static_cast<std::uint32_t>(setup_.line.stations)) continue;
    if (event.kind == EventKind::Ended) noteEnd(event, news);
    else if (!obey(event, news)) heard_.push_back(event);
  }
}

// Whoever is admitted to the network can write an event; only the conductor's word counts, and who that is its card says. False: not known yet.
bool StationRun::obey(const LineEvent& event, StationNews& news) {
  if (isConductor()) return true;
  const std::optional<bool> conducts = line_->isConductor(event.station);
  if (!conducts) return false;
  if (!*conducts) {
    news.words.push_back(fmt::format("station {} is not the conductor: what it tells the others to do is left undone", event.station));
    return true;
  }
  if (event.kind == EventKind::Arm) {
    armAsked_ = event.trial;
    planned_ = event.planned;
    if (event.frequency > 0) frequency_ = event.frequency;
  }
  if (event.kind == EventKind::Interrupt) {
    if (stage_ == Stage::UnderWay) abort();
    else armed_ = std::max(armed_, armAsked_);  // over before it was put up
  }
  if (event.kind == EventKind::Finish) finished_ = true;
  return true;
}

void StationRun::noteEnd(const LineEvent& event, StationNews& news) {
  endedTrial_.at(event.station - 1) = event.trial;
  if (line_->isConductor(event.station).value_or(false)) verdict_ = event;
  news.words.push_back(wordsOf(event));
}

std::string StationRun::close() {
  if (closed_) return {};
  closing_.request_stop();
  std::string said;
  if (run_ != nullptr) {
    keepTheLast();
    sayGoodbye();
    run_->note(fmt::format("network: {} bytes of states came twice or after newer ones and were dropped; {} samples found no room",
                           line_->memory().discardedBytes.load(), line_->memory().ringsFull.load()));
    run_->closeLog();
    said = line_->describe();
  }
  closed_ = true;
  if (const std::string fault = line_->finish(); !fault.empty()) said += fault + "\n";
  return said;
}

// The loop runs until the log is closed: what it gave the copy after the last look would be missing in the log.
void StationRun::keepTheLast() {
  constexpr int kLooks = 50;  // milliseconds; a loop that hangs gives nothing
  sink_->stopGiving();
  for (int look = 0; look < kLooks && !sink_->hasStoppedGiving(); ++look) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  keep();
}

// What follows has to be done whether anybody hears this or not.
void StationRun::sayGoodbye() {
  if (!isConductor() || finishTold_ || !line_->endpointFault().empty()) return;
  try {
    if (stage_ == Stage::UnderWay && !aborted_) tell(EventKind::Interrupt);
    tell(EventKind::Finish);
  } catch (const ResourceError&) {  // it takes no messages: `finish` says how it ended
  }
}

}  // namespace reachlab::network
