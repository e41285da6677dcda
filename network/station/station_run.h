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

/// The request for a station, from any front end.
struct StationSetup {
  StationOptions link;
  bool insecure = false;  // no certificates are used, by explicit request
  double wait = 60;       // [s] for the other stations
  int rate = 1000;        // [1/s] at which its state is sent
};

/// The events since the last call.
struct StationNews {
  std::vector<std::string> words;                // for the experimenter, one text per line
  std::string notArmed;                          // the reason for not arming, where it differs from the reason at the last call
  bool begun = false;                            // a trial was prepared
  std::optional<haptics::ConductedTrial> ended;  // a trial ended and is safe on the disk
  // the reason why running is in vain: nobody came, nobody arms, the endpoint has ended; repeated after another `wait`
  std::string problem;
  bool finished = false;  // no more trials: the conductor said so, or this station stopped
};

/// The trials of one station, from its first message to its last. The conductor arms trial after trial, on request and while every link is
/// good. The other stations prepare the armed trial. It never waits. Call `poll` often. Every call comes from one thread at a time.
///
///   StationRun station(setup, block.experiment);
///   station.prepare(options);
///   RecordedRun run(block, device, options);
///   station.begin(run);
///   for (…) { station.armNext(); station.poll() … }
///   station.close();
class StationRun {
 public:
  /// Starts the endpoint. Throws FaultError for an experiment without a hand for each station, or without a hand for this station. Throws
  /// ResourceError.
  StationRun(const StationSetup& setup, const experiment::CompiledExperiment& experiment);
  ~StationRun();
  StationRun(const StationRun&) = delete;
  StationRun& operator=(const StationRun&) = delete;

  /// Options for a run that uses this station's copy as its engine and sends its ticks to the link.
  void prepare(session::RecordedRunOptions& options);
  /// Takes the run that was made with these options. Its loop begins, and with it the link. The run is closed or destroyed before this
  /// object.
  void begin(session::RecordedRun& run);
  /// The trial seed of the hand at this station, from one seed for all hands.
  std::uint64_t seedHere(std::uint64_t seed) const;

  bool isConductor() const { return setup_.link.conductor; }
  int station() const { return setup_.link.station; }
  /// Conductor only. Requests the next trial. It begins when every station has reported the end of the trial before and every link is good.
  void armNext();
  /// A trial is requested and not armed yet.
  bool isArming() const { return (stage_ > Stage::Idle && stage_ < Stage::UnderWay) || stage_ == Stage::OthersThenNext; }
  /// The conductor is between two trials.
  bool isIdle() const { return stage_ == Stage::Idle; }
  /// Ends the trial under way. On the conductor it ends the trial at every station. Withdraws a request that is not armed yet.
  void abort();
  /// The same, and no more trials follow.
  void stop();

  StationNews poll();
  /// Keeps the samples of the other stations in the log. Call it between two calls of `poll` that are far apart.
  void keep();

  /// Ends the link and closes the run's log. Returns messages about the link, one per line. A second call has no effect.
  std::string close();

  StationLink& link() { return *link_; }
  /// The positions of the other hands, by station from 0. Known after the first sample.
  const OtherHands& otherHands() const { return others_; }

 private:
  /// For one trial.
  enum class Stage {
    Idle,
    Wanted,          // the conductor: the next trial is to be armed
    Links,           // waits until every link is good
    Settling,        // listens to the links for a while
    LinksAgain,      // waits until they are good again
    Checking,        // simulates the object over them
    UnderWay,        // the engine runs the trial
    Aborting,        // the same, and the trial is to be ended
    Others,          // the conductor: waits until the other stations report the end of the trial
    OthersThenNext,  // the same, and then the next trial is to be armed
    Over             // no more trials
  };
  /// For the run.
  // a follower has begun once it knows the messages from before its arrival
  enum class Progress { New, Begun, Stopping, Finished, Closed };
  /// The run asks for its watcher before it makes the engine and with it the sink.
  struct Watcher final : haptics::RunSink, record::FurtherColumns {
    StationSink* sink = nullptr;
    bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missed) noexcept override {
      return sink->onTick(state, command, missed);
    }
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
  double until_ = 0;    // [s] time limit of this stage
  double settled_ = 0;  // [s] when the messages from before this station's arrival are known to hold; 0: no such message
  std::string said_;
  std::stop_source closing_;         // ends the wait for the computation
  std::future<LinkCheck> checking_;  // on the conductor, in a separate thread
  MeasuredLink checkedFor_;          // link of that check, or of the last good check
  double frequency_ = 0;             // [rad/s] omega_o of the check; 0: no check yet
  std::deque<LinkEvent> heard_;      // of stations that have not yet sent their identity
  std::int32_t armed_ = 0, armAsked_ = 0, putUp_ = 0, trialsBefore_ = 0;
  trial::PlannedTrial planned_;
  TrialWords words_;
  std::optional<haptics::ConductedTrial> ended_;  // ended here, and some station has not yet reported its end
  double wordsUntil_ = 0;                         // [s] when the wait for the other stations' reports ends
};

}  // namespace reachlab::network
