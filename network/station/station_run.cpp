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
#include "sim/session/plan.h"

namespace reachlab::network {
namespace {

constexpr double kGoodFor = 0.5;  // [s] the links are heard before a trial
constexpr double kPatience = 3;   // [s] for every station's word on a trial
// share and [s] by which a round trip may become longer until it is simulated again
constexpr double kLongerTrip = 0.25, kLongerBy = 0.005;
constexpr double kOldWords = 0.05;      // [s] in which it is known whether a trial told of has ended already
constexpr std::size_t kMostHeard = 64;  // events of stations that do not say who they are

double now() { return static_cast<double>(os::now()) * 1e-9; }

StationSetup forExperiment(StationSetup setup, const experiment::Experiment& experiment) {
  const int hands = static_cast<int>(experiment.hands.size());
  if (hands < 2) throw FaultError(Fault{"hands", fmt::format("are {}", std::max(hands, 1)), "an experiment with a hand for each station"});
  if (setup.link.station > hands)
    throw FaultError(
        Fault{"number", fmt::format("is {}, and the experiment has {} hands", setup.link.station, hands), fmt::format("1 to {}", hands)});
  setup.link.stations = hands;
  return setup;
}

// Lines between two others are not known here: they are taken to be as bad.
MeasuredLink worstLink(const StationLink& link) {
  MeasuredLink worst;
  for (const StationStatus& other : link.statuses()) worst = MeasuredLink::worse(worst, {other.roundTrip, other.jitter, other.loss});
  return worst;
}

}  // namespace

StationRun::StationRun(const StationSetup& setup, const experiment::CompiledExperiment& experiment)
    : setup_(forExperiment(setup, experiment.experiment())), own_(setup.link.station - 1), experiment_(experiment.experiment()),
      link_(std::make_unique<StationLink>(setup_.link, sharedHash(experiment.experiment()))), until_(now() + setup.wait) {}

StationRun::~StationRun() { closing_.request_stop(); }

void StationRun::prepare(session::RecordedRunOptions& options) {
  options.makeEngine = [this](const experiment::CompiledExperiment& e, const haptics::EngineOptions& engine) {
    CoupledCopy* copy = nullptr;
    auto made = makeStationEngine(e, own_, engine, copy);
    sink_ = std::make_unique<StationSink>(link_->memory(), *copy, own_, 1000 / setup_.rate);
    watcher_.sink = sink_.get();
    return made;
  };
  options.watchers.push_back(&watcher_);
  options.furtherChannels = linkChannels(setup_.link.station, setup_.link.stations);
  options.further = &watcher_;
  options.timingCheckSeconds = 0;  // a trial is put up when the others put it up
}

void StationRun::begin(session::RecordedRun& run) {
  run_ = &run;
  run.note(fmt::format("station {} of {}{}, {}", setup_.link.station, setup_.link.stations, setup_.link.conductor ? ", conductor" : "",
                       setup_.insecure ? "not encrypted" : "encrypted"));
  const std::atomic<bool> never{false};
  run.checkTiming(never);  // nothing to check: the loop runs from here on
}

std::uint64_t StationRun::seedHere(std::uint64_t seed) const { return seededBits(seed, static_cast<std::uint64_t>(own_)); }

void StationRun::armNext() {
  if (!isConductor() || progress_ >= Progress::Stopping) return;
  if (stage_ == Stage::Idle) stage_ = Stage::Wanted;
  if (stage_ == Stage::Others) stage_ = Stage::OthersThenNext;
}

void StationRun::abort() {
  if (isArming()) stage_ = Stage::Idle;
  if (stage_ != Stage::UnderWay) return;
  stage_ = Stage::Aborting;
  if (isConductor()) tell(LinkEvent::Kind::Interrupt);
  run_->abort();
}

void StationRun::stop() {
  progress_ = std::max(progress_, Progress::Stopping);
  abort();
}

void StationRun::keep() {
  link_->look();
  if (run_ == nullptr || progress_ == Progress::Closed) return;
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
  if (isUnderWay()) return news;
  if (progress_ == Progress::Stopping) {
    if (isConductor()) tell(LinkEvent::Kind::Finish);
    progress_ = Progress::Finished;
  }
  if (progress_ == Progress::Finished) stage_ = Stage::Over, news.finished = true;
  return news;
}

void StationRun::lead(StationNews& news) {
  switch (stage_) {
    case Stage::Idle:
    case Stage::Over: return;
    case Stage::Wanted:
      stage_ = Stage::Links;
      until_ = now() + setup_.wait;
      said_.clear();
      [[fallthrough]];
    case Stage::Links:
    case Stage::LinksAgain: return awaitLinks(news);
    case Stage::Settling:
      if (now() >= until_) stage_ = Stage::LinksAgain, until_ = now() + setup_.wait;
      return;
    case Stage::Checking: return awaitCheck(news);
    case Stage::UnderWay:
    case Stage::Aborting:
      if (news.ended) stage_ = Stage::Others;
      return;
    case Stage::Others:
    case Stage::OthersThenNext:
      const std::string silent = words_.missing(armed_, setup_.link.stations, own_);
      if (!silent.empty() && now() < wordsUntil_ && progress_ < Progress::Stopping) return;
      if (!silent.empty()) news.words.push_back(fmt::format("no word on trial {} of station {}", armed_, silent));
      stage_ = stage_ == Stage::Others ? Stage::Idle : Stage::Wanted;
  }
}

bool StationRun::isChecked() const {
  const double trip = worstLink(*link_).roundTrip;
  return frequency_ > 0 && trip <= checkedFor_.roundTrip * (1 + kLongerTrip) + kLongerBy;
}

// Before the first trial, and when a link has become much longer. The simulation takes a tenth of a second or several; nobody waits for it.
void StationRun::check() {
  stage_ = Stage::Checking;
  if (checking_.valid()) return;  // asked for before a trial that was taken back
  checkedFor_ = worstLink(*link_);
  checking_ = std::async(std::launch::async, [experiment = experiment_, link = checkedFor_, stop = closing_.get_token()] {
    return checkLink(experiment, link, stop);
  });
}

void StationRun::awaitCheck(StationNews& news) {
  if (checking_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  const LinkCheck found = checking_.get();
  run_->note(found.sentence);
  if (!found.stable) {
    stage_ = Stage::Idle;
    frequency_ = 0;
    return inVain("no trial was armed: " + found.sentence, news);
  }
  if (found.frequency > copySettingsFor(experiment_).frequency) news.words.push_back(found.sentence);
  frequency_ = std::max(frequency_, found.frequency);
  stage_ = Stage::LinksAgain;
  until_ = now() + setup_.wait;
}

// Twice good, and time between: the links are heard before a trial.
void StationRun::awaitLinks(StationNews& news) {
  const std::vector<std::string> obstacles = link_->obstacles();
  if (obstacles.empty()) {
    if (stage_ == Stage::LinksAgain) return isChecked() ? putUp(news) : check();
    stage_ = Stage::Settling;
    until_ = now() + kGoodFor;
    return;
  }
  const std::string all = fmt::format("{}", fmt::join(obstacles, "; "));
  if (all != said_) news.notArmed = said_ = all;
  if (now() <= until_ && link_->endpointFault().empty()) return;
  stage_ = Stage::Idle;
  inVain("no trial was armed: " + all, news);
}

void StationRun::putUp(StationNews& news) {
  wordsUntil_ = 0;  // a word on the last trial that has not come by now does not matter any more
  keepVerdict(news);
  if (isConductor()) {
    const trial::PlannedTrial* next = run_->nextPlanned();
    if (next == nullptr) {
      stage_ = Stage::Idle;
      return;
    }
    LinkEvent arm;
    arm.kind = LinkEvent::Kind::Arm;
    arm.planned = *next;
    arm.trial = ++armed_;
    arm.frequency = frequency_;
    link_->send(arm);
  } else {
    armed_ = armAsked_;
    if (run_->trialsLeft() == 0) run_->repeat(planned_);
  }
  trialsBefore_ = armed_ - ++putUp_;  // this station may have come back in mid-run
  sink_->countTrialsFrom(trialsBefore_);
  sink_->synchroniseBy(frequency_);
  ended_.reset();
  (void)run_->putUpNext();
  stage_ = Stage::UnderWay;
  news.begun = true;
}

void StationRun::follow(StationNews& news) {
  if (isUnderWay() && news.ended) stage_ = Stage::Idle;
  // The conductor has given this trial up, has finished, or is gone. A trial that has begun goes to its end.
  if (stage_ == Stage::UnderWay && run_->latest().phase == trial::Phase::Waiting &&
      (armAsked_ > armed_ || progress_ >= Progress::Finished || link_->conductorSilence() > setup_.wait))
    abort();
  if (stage_ != Stage::Idle || progress_ >= Progress::Stopping) return;
  if (words_.anyOn(armAsked_)) armed_ = armAsked_;  // over without this one
  if (armed_ < armAsked_) {
    // What was told before this station came: has that trial ended?
    const bool begun = progress_ == Progress::Begun;
    if (!begun && settled_ == 0) settled_ = now() + kOldWords;
    if (begun || now() >= settled_) {
      progress_ = Progress::Begun;
      return putUp(news);
    }
  } else {
    settled_ = 0;
  }
  if (const std::string fault = link_->endpointFault(); !fault.empty()) return inVain(fault, news);
  if (progress_ == Progress::New && now() > until_) {
    std::string why;
    for (const std::string& one : link_->obstacles()) why += "; " + one;
    return inVain(fmt::format("the conductor armed no trial within {:.0f} s{}", setup_.wait, why), news);
  }
  if (progress_ == Progress::Begun && link_->conductorSilence() > setup_.wait)
    inVain(fmt::format("the conductor was not heard of for {:.0f} s", setup_.wait), news);
}

// Not at every look again.
void StationRun::inVain(const std::string& what, StationNews& news) {
  if (what == said_ && now() <= until_) return;
  said_ = what;
  until_ = now() + setup_.wait;
  news.problem = what;
}

void StationRun::tell(LinkEvent::Kind kind) {
  LinkEvent event;
  event.kind = kind;
  event.trial = armed_;
  link_->send(event);
}

void StationRun::tellEnd(const haptics::ConductedTrial& trial) {
  LinkEvent event;
  event.kind = LinkEvent::Kind::Ended;
  event.trial = trial.trial + trialsBefore_;
  event.outcome = trial.result.outcome;
  event.reason = trial.result.reason;
  const TowardsOthers& towards = sink_->towardsOthers();
  event.apart = towards.rmsApart;
  link_->send(event);
  event.station = static_cast<std::uint32_t>(setup_.link.station);
  words_.add(event);
  ended_ = trial;
  wordsUntil_ = now() + kPatience;
  run_->note(
      fmt::format("trial {}: copies apart {:.6g} m RMS, {:.6g} m at most; other hands' samples up to {:.6g} s old, held by less than "
                  "their full coupling for {} ticks; {} samples were no newer than one before",
                  run_->numberOf(trial), towards.rmsApart, towards.mostApart, towards.oldest, towards.fadedTicks, towards.repeated));
}

// Each station keeps what holds for all beside what its own copy came to, and how far apart the copies were then.
void StationRun::keepVerdict(StationNews& news) {
  if (!ended_) return;
  const std::int32_t number = ended_->trial + trialsBefore_;
  const auto verdict = words_.verdictOn(number, [this](std::uint32_t station) {
    return station == static_cast<std::uint32_t>(setup_.link.station) ? isConductor() : link_->isConductor(station).value_or(false);
  });
  const bool allSaid = words_.missing(number, setup_.link.stations, own_).empty();
  if (!verdict || (!allSaid && now() < wordsUntil_)) return;
  const LinkEvent& judged = verdict->word;
  const std::string outcome = wordsOf(judged.outcome, judged.reason), here = wordsOf(ended_->result.outcome, ended_->result.reason);
  run_->note(fmt::format("trial {}: outcome {} by {} {}; {} here, where the copies were {:.6g} m apart at its end", run_->numberOf(*ended_),
                         outcome, verdict->brokenOff ? "the one that broke it off, station" : "the conductor, station", judged.station,
                         here, sink_->towardsOthers().lastApart));
  if (judged.outcome != ended_->result.outcome) {
    const std::string why =
        verdict->brokenOff ? fmt::format(", because station {} broke it off", judged.station) : " by the conductor's copy, which counts";
    news.words.push_back(fmt::format("trial {}: {}{}; {} by the copy here", number, outcome, why, here));
  }
  ended_.reset();
}

void StationRun::takeEvents(StationNews& news) {
  LinkEvent event;
  while (link_->memory().eventsIn.tryPop(event))
    if (heard_.size() < kMostHeard) heard_.push_back(event);
  for (std::size_t left = heard_.size(); left > 0; --left) {
    event = heard_.front();
    heard_.pop_front();
    if (event.station < 1 || event.station > static_cast<std::uint32_t>(setup_.link.stations)) continue;
    if (event.kind == LinkEvent::Kind::Ended) noteEnd(event, news);
    else if (!obey(event, news)) heard_.push_back(event);
  }
}

// Whoever is admitted to the network can write an event; only the conductor's word counts, and who that is its card says. False: not known yet.
bool StationRun::obey(const LinkEvent& event, StationNews& news) {
  if (isConductor()) return true;
  const std::optional<bool> conducts = link_->isConductor(event.station);
  if (!conducts) return false;
  if (!*conducts) {
    news.words.push_back(fmt::format("station {} is not the conductor: what it tells the others to do is left undone", event.station));
    return true;
  }
  if (event.kind == LinkEvent::Kind::Arm) {
    armAsked_ = event.trial;
    planned_ = event.planned;
    if (event.frequency > 0) frequency_ = event.frequency;
  }
  if (event.kind == LinkEvent::Kind::Interrupt) {
    if (stage_ == Stage::UnderWay) abort();
    else armed_ = std::max(armed_, armAsked_);  // over before it was put up
  }
  if (event.kind == LinkEvent::Kind::Finish) progress_ = std::max(progress_, Progress::Finished);
  return true;
}

// Who broke the trial off has let go of the object: it is over for all.
void StationRun::noteEnd(const LinkEvent& event, StationNews& news) {
  words_.add(event);
  // A conductor that was started again counts on from what the others have ended, because they prepare no trial twice.
  if (isConductor() && putUp_ == 0 && event.trial < session::kMaxTrials) armed_ = std::max(armed_, event.trial);
  if (stage_ == Stage::UnderWay && event.trial == armed_ && isBrokenOff(event))
    sink_->breakOff(static_cast<int>(event.station), event.trial);
  news.words.push_back(wordsOf(event));
}

std::string StationRun::close() {
  if (progress_ == Progress::Closed) return {};
  closing_.request_stop();
  std::string said;
  if (run_ != nullptr) {
    keepTheLast();
    sayGoodbye();
    StationNews late;
    wordsUntil_ = 0;
    keepVerdict(late);
    run_->note(fmt::format("network: {} bytes of states came twice or after newer ones and were dropped; {} samples found no room",
                           link_->memory().discardedBytes.load(), link_->memory().ringsFull.load()));
    run_->closeLog();
    said = link_->describe();
  }
  progress_ = Progress::Closed;
  if (const std::string fault = link_->finish(); !fault.empty()) said += fault + "\n";
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
  if (!isConductor() || progress_ == Progress::Finished || !link_->endpointFault().empty()) return;
  try {
    if (stage_ == Stage::UnderWay) tell(LinkEvent::Kind::Interrupt);
    tell(LinkEvent::Kind::Finish);
  } catch (const ResourceError&) {  // it takes no messages: `finish` says how it ended
  }
}

}  // namespace reachlab::network
