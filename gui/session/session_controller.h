#pragma once
#include <QObject>
#include <QString>
#include <QStringList>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "base/fault.h"
#include "base/system/stop_signals.h"
#include "gui/plot/trial_trace.h"
#include "network/station/observer.h"
#include "network/station/station_run.h"
#include "sim/session/backup_worker.h"
#include "sim/session/recorded_session.h"

namespace reachlab::devices {
class MouseDevice;
}

namespace reachlab::gui::app {

/// The session behind the window: the opened or edited programme, and the open run. Uses no widget. A change ends the open run, a trial
/// under way is kept as interrupted, and the next trial opens a new run with the new settings, so that each log holds one configuration. A
/// signal that asks the program to end (base/system/stop_signals.h) ends it within a second, even if the window is busy. A separate thread
/// then keeps the trial as interrupted and closes the log.
class SessionController : public QObject {
  Q_OBJECT
 public:
  /// Reads the experiment, or the plan and its first block. Throws FaultError. `station`: this window is one of several stations that move
  /// one object together. Then a plan is a fault, too.
  explicit SessionController(const session::SessionRequest& request, std::optional<network::StationSetup> station = std::nullopt,
                             QObject* parent = nullptr);
  ~SessionController() override;

  /// The shown experiment, which is that of the plan's open or first block if there is a plan.
  const experiment::Experiment& experiment() const { return shown_.experiment(); }
  const experiment::CompiledExperiment& compiled() const { return shown_; }
  const session::Programme& programme() const { return programme_; }
  /// A plan has its settings in its file: they are shown, not edited.
  bool isPlan() const { return programme_.isPlan(); }

  /// The scenes of the plan's block that is shown. Null for a block of one scene.
  const std::vector<session::BlockScene>* shownScenes() const;
  /// Starts and targets [m] of these scenes, each once.
  std::vector<Vec3> blockPlaces() const;

  /// Takes the programme over from the next run on. Label, condition and log name belong to it.
  void setProgramme(const session::Programme& programme);
  /// Every fault of an edited experiment. It is taken over if there is no fault. Throws RefusedError if the scene cannot be computed.
  std::vector<Fault> tryEdit(const experiment::Experiment& experiment);
  /// The next session that is opened resumes the unfinished work of this subject's session.
  void resume() { planAnew(true); }
  /// The same for another session, before its programme is taken over.
  void resume(const session::SessionRequest& request);
  bool resumes() const { return resume_; }
  /// The next session that is opened begins from the first block.
  void beginAnew() { planAnew(false); }

  /// At a station: opens its run, so that the others hear of it. Throws children of Error.
  void join(const session::SessionRequest& request);
  /// Begins the next trial, and first opens a run if no run is open. Returns false if a plan has no trial left. Throws children of Error.
  /// At a station, the conductor arms the trial as soon as every link is good, and the other stations wait for that.
  bool next(const session::SessionRequest& request);
  void abort();
  /// Repeats the last trial at the end of the run. Returns false if there was no trial.
  bool repeat();
  /// Cancels the last repeat. Returns false if no repeat is left.
  bool takeBackRepeat();
  /// [s] of rest that the plan still asks for before its next block. 0: the block may begin.
  double restLeft() const;
  /// True once, when the pause before a trial that comes by itself is over.
  bool takeNextTrial();
  void cancelPause();
  /// Asked after each trial: the pause [s] before the next trial begins by itself, if the plan has no pause. nullopt: the next trial waits
  /// for a key.
  void setOwnPause(std::function<std::optional<double>()> ownPause) { ownPause_ = std::move(ownPause); }
  /// Of the open block or, after its end, of the next block. Empty if there is no instruction.
  QString instructions();
  void note(const QString& text);
  /// Returns false if the log or the dataset could not be completed. `failed` tells then where the finished trials are.
  bool endRun();
  void pointTo(const Vec3& place, qint64 eventMs);
  /// Looks at the newest state. From the frame timer.
  void poll();
  /// The oldest point of the trace not yet taken.
  bool tryTake(plot::TracePoint& point) { return trace_.tryTake(point); }
  /// The mass that the trace tells of besides the hand and the last mass. -1: the hand.
  void watch(int mass) { trace_.watch(mass); }

  session::RecordedRun* run() { return recorded_ ? recorded_->run() : nullptr; }  // null: none is open
  /// Blocks of the plan after the one that is open.
  std::size_t blocksLeft() const { return recorded_ && isPlan() ? recorded_->blocksLeft() : 0; }
  /// Of the plan, as this session does them.
  std::size_t blockCount() { return run() != nullptr ? static_cast<std::size_t>(run()->configuration().block) + blocksLeft() : 0; }
  bool underWay() { return run() != nullptr && (run()->underWay() || isArming()); }
  /// The station of this window, by its setup. Null for a window without stations.
  const network::StationSetup* station() const { return setup_ ? &*setup_ : nullptr; }
  /// Begins only the trials that the conductor arms.
  bool follows() const { return setup_ && !setup_->link.conductor; }
  /// No hand is at this station, and the window shows the movement of the other stations.
  bool observes() const { return setup_ && setup_->link.station == 0; }
  /// The state of an observed run. Null before the first state, or if a hand is here.
  const haptics::TickState* seen() const { return observer_ ? observer_->state() : nullptr; }
  /// A trial is to be armed, and is not yet.
  bool isArming() { return station_ && station_->isArming(); }
  /// The state of the other stations. Empty while no run is open.
  std::vector<network::StationStatus> statuses();
  /// Of a station's run: where the other hands are.
  network::OtherHands otherHands();
  std::optional<haptics::ConductedTrial> lastTrial() const { return last_; }

 Q_SIGNALS:
  void experimentChanged();
  void runOpened();
  void runClosed();
  void trialBegun();
  void trialEnded();
  /// One sentence for the experimenter: the disk, the device, the computation. Finished trials are safe.
  void failed(const QString& sentence);
  /// News of a success.
  void done(const QString& sentence);
  /// Remarks that are no faults: sentences, one per line.
  void told(const QString& sentence);
  /// Messages of the other stations, such as the end of a trial or a silent station.
  void stationTold(const QString& line);

 private:
  void planAnew(bool resume);
  void openRun(const session::SessionRequest& request);
  void planRuns(const session::SessionRequest& request);
  void tellStation(const network::StationNews& news);
  void observe();
  void showScene();
  std::unique_ptr<haptics::HapticDevice> makeDeviceHere(const std::string& spec, std::span<const experiment::CompiledExperiment> scenes,
                                                        std::uint64_t seed);
  void fail(const QString& fault);
  QString putInOrder();
  void tellTiming();
  void tellInstruments();
  void tellBackup();
  void endOnSignal(const std::stop_token& over);
  void keepStation();
  void stopInOrder();

  session::Programme programme_;
  experiment::CompiledExperiment shown_;
  bool resume_ = false;
  bool timingTold_ = false;                // of the run that is open
  std::optional<StopRequest> stop_;        // while a run is open a signal ends its trial first; at other times the program, at once
  QStringList onOpening_;                  // what is to be said of the run that is being opened, all at once
  bool numberUsed_ = false;                // the run number that was asked for holds for one run
  session::SessionRequest asked_;          // what `recorded_` was planned for
  devices::MouseDevice* mouse_ = nullptr;  // inside the run that is open
  std::shared_ptr<void> learnt_;           // by a virtual person, from block to block of the session
  plot::TraceSink trace_;                  // outlives the runs
  std::unique_ptr<record::InstrumentLink> instruments_;  // so do these
  std::string backupOf_;                                 // the dataset that this is of
  std::optional<session::BackupWorker> backup_;
  session::BackupState::Kind backupTold_ = session::BackupState::Kind::Idle;
  std::optional<network::StationSetup> setup_;
  std::unique_ptr<network::StationRun> station_;  // of the run that is open, and outlives it
  std::unique_ptr<network::Observer> observer_;
  std::unique_ptr<session::RecordedSession> recorded_;
  std::optional<haptics::ConductedTrial> last_;
  std::function<std::optional<double>()> ownPause_;
  // Held by the thread that changes the open run or checks for one: the window's, or the thread below.
  std::mutex changing_;
  std::jthread endsOnSignal_;  // last: it looks at all of the above
};

}  // namespace reachlab::gui::app
