#pragma once
#include <array>
#include <deque>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "network/link/station_link.h"
#include "network/link/station_replay.h"
#include "network/link/station_sink.h"
#include "network/link_check/link_check.h"
#include "network/station/trial_words.h"
#include "sim/experiment/experiment.h"
#include "sim/session/recorded_run.h"

namespace reachlab::network {

/// What is asked of a station, by whatever front end.
struct StationSetup {
  StationOptions link;
  bool insecure = false;  // in so many words
  double wait = 60;       // [s] for the other stations
  int rate = 1000;        // [1/s] at which its state is sent
};

/// What has happened since the last look.
struct StationNews {
  std::vector<std::string> words;                // for the experimenter, a line each
  std::string notArmed;                          // why, where it is another reason than at the last look
  bool begun = false;                            // a trial was put up
  std::optional<haptics::ConductedTrial> ended;  // and is safe on the disk
  std::string problem;                           // in vain: nobody came, nobody arms, the endpoint has ended. Again after another `wait`
  bool finished = false;                         // no more trials: the conductor said so, or this one stopped
};

/// The trials of one station, from its first word to its last. The conductor arms trial after trial, when it is told to and every link is
/// good; the others put up what it arms. Never waits; `poll` it often. Every call from one thread at a time.
///
///   StationRun station(setup, block.experiment);
///   station.prepare(options);
///   RecordedRun run(block, device, options);
///   station.begin(run);
///   for (…) { station.armNext(); station.poll() … }
///   station.close();
class StationRun {
 public:
  /// Starts the endpoint. Throws FaultError: an experiment without a hand for each station, or not for this one; ResourceError.
  StationRun(const StationSetup& setup, const experiment::CompiledExperiment& experiment);
  ~StationRun();
  StationRun(const StationRun&) = delete;
  StationRun& operator=(const StationRun&) = delete;

  /// A run made with these has this station's copy for its engine, and its ticks go to the link.
  void prepare(session::RecordedRunOptions& options);
  /// The run that was made so; its loop begins, and with it the link. It is closed, or gone, before this is.
  void begin(session::RecordedRun& run);
  /// Of the hand here, from one seed for all of them.
  std::uint64_t seedHere(std::uint64_t seed) const;

  bool isConductor() const { return setup_.link.conductor; }
  int station() const { return setup_.link.station; }
  /// The conductor: the next trial, as soon as every station has had its word on the one before and every link is good.
  void armNext();
  /// It is to be armed and has not been yet.
  bool isArming() const { return (stage_ > Stage::Idle && stage_ < Stage::UnderWay) || stage_ == Stage::OthersThenNext; }
  /// The conductor is between two trials.
  bool isIdle() const { return stage_ == Stage::Idle; }
  /// Ends the trial under way, the conductor at every station; or no longer wants one to be armed.
  void abort();
  /// The same, and then no more trials.
  void stop();

  StationNews poll();
  /// What came from the others is kept in the log; between two looks, where they are far apart.
  void keep();

  /// Ends the line and closes the run's log. What is to be said of the line, a line each. Idempotent.
  std::string close();

  StationLink& link() { return *link_; }
  /// Where the other hands are, by station from 0; known once something came.
  const OtherHands& otherHands() const { return others_; }

 private:
  /// Of one trial.
  enum class Stage {
    Idle,
    Wanted,          // the conductor: the next trial is to be armed
    Links,           // waits for every link to be good,
    Settling,        // hears them for a while,
    LinksAgain,      // and wants them to be good still
    Checking,        // simulates the object over them
    UnderWay,        // at the engine
    Aborting,        // the same, and to be ended
    Others,          // the conductor: waits for the other stations' words on the trial
    OthersThenNext,  // the same, and then the next is to be armed
    Over             // no more trials
  };
  /// Of the run.
  enum class Progress { New, Begun, Stopping, Finished, Closed };  // a follower has begun once it knows what was told before it came
  /// The run asks for its watcher before the engine, and with it the sink, is made.
  struct Watcher final : haptics::RunSink, record::FurtherColumns {
    StationSink* sink = nullptr;
    bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missed) noexcept override {
      return sink->onTick(state, command, missed);
    }
    void announce(std::int32_t, const trial::PlannedTrial&) override {}
    void awaitTrial(std::int32_t) override {}
    void close() override {}
    void fill(double* columns) const noexcept override { sink->fill(columns); }
  };

  bool isUnderWay() const { return stage_ == Stage::UnderWay || stage_ == Stage::Aborting; }
  void awaitLinks(StationNews& news);
  bool isChecked() const;
  void check();
  void awaitCheck(StationNews& news);
  void putUp(StationNews& news);
  void lead(StationNews& news);
  void follow(StationNews& news);
  void tellEnd(const haptics::ConductedTrial& trial);
  void tell(LinkEvent::Kind kind);
  void keepTheLast();
  void sayGoodbye();
  void takeEvents(StationNews& news);
  bool obey(const LinkEvent& event, StationNews& news);
  void noteEnd(const LinkEvent& event, StationNews& news);
  void keepVerdict(StationNews& news);
  void inVain(const std::string& what, StationNews& news);

  StationSetup setup_;
  int own_;  // from 0
  experiment::Experiment experiment_;
  std::unique_ptr<StationLink> link_;
  std::unique_ptr<StationSink> sink_;
  Watcher watcher_;
  session::RecordedRun* run_ = nullptr;
  OtherHands others_;
  Stage stage_ = Stage::Idle;
  Progress progress_ = Progress::New;
  double until_ = 0;    // [s] that this stage may take
  double settled_ = 0;  // [s] when what was told before this station came is known to hold; 0: nothing was told
  std::string said_;
  std::stop_source closing_;         // what is being computed is not waited for any more
  std::future<LinkCheck> checking_;  // the conductor's, on a thread of its own
  MeasuredLink checkedFor_;          // of that or of the last that was well
  double frequency_ = 0;             // [rad/s] omega_o that was found; 0: nothing was checked yet
  std::deque<LinkEvent> heard_;      // of stations that have not said yet who they are
  std::int32_t armed_ = 0, armAsked_ = 0, putUp_ = 0, trialsBefore_ = 0;
  trial::PlannedTrial planned_;
  TrialWords words_;
  std::optional<haptics::ConductedTrial> ended_;  // here, and not all have had their word on it
  double wordsUntil_ = 0;                         // [s] when they are not waited for any more
};

}  // namespace reachlab::network
