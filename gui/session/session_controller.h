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

/// The session behind the window: what is to be done, as opened or edited, and the run that is open. Knows no widget. Changes take effect
/// between trials: a run that is open is then ended, and the next trial opens a new one with the new settings, so that each log holds one
/// configuration. A signal that asks the program to end (base/system/stop_signals.h) ends it within a second whatever the window is busy with (a large
/// picture, a table): the trial is kept as interrupted, and the log is closed, by a thread of its own.
class SessionController : public QObject {
  Q_OBJECT
 public:
  /// Reads the experiment, or the plan and its first block. Throws FaultError.
  /// `station`: this window is one of several that move one object together; then FaultError for a plan, too.
  explicit SessionController(const session::SessionRequest& request, std::optional<network::StationSetup> station = std::nullopt,
                             QObject* parent = nullptr);
  ~SessionController() override;

  /// What is shown: the experiment, or that of the plan's block that is open or comes first.
  const experiment::Experiment& experiment() const { return shown_.experiment(); }
  const constraints::Constraint& constraint() const { return shown_.constraint(); }
  const experiment::CompiledExperiment& compiled() const { return shown_; }
  const session::Programme& programme() const { return programme_; }
  /// A plan has its settings in its file: they are shown, not edited.
  bool isPlan() const { return programme_.isPlan(); }

  /// Takes over what is to be done from the next run on: label, condition and log name are its own.
  void setProgramme(const session::Programme& programme);
  /// Every fault of an edited experiment; it is taken over when there is none. Throws RefusedError when the scene cannot be computed.
  std::vector<Fault> tryEdit(const experiment::Experiment& experiment);
  /// The next session that is opened goes on with what this subject's session has left undone.
  void resume();
  /// The next session that is opened begins from the first block.
  void beginAnew();

  /// At a station: opens its run, so that the others hear of it. Throws children of Error.
  void join(const session::SessionRequest& request);
  /// Puts the next trial up; opens a run first if none is open. False when nothing is left of a plan. Throws children of Error. At a station the
  /// conductor arms it as soon as every line is good, and the others wait for that.
  bool next(const session::SessionRequest& request);
  void abort();
  /// The last trial once more, at the end of the run. False when there was none.
  bool repeat();
  /// The last repeat is not done after all. False when none is still to come.
  bool takeBackRepeat();
  /// [s] that the plan rests yet before its next block; 0: it may begin.
  double restLeft() const;
  /// True once, when the pause before a trial that comes by itself is over.
  bool takeNextTrial();
  void cancelPause();
  /// Asked after each trial: [s] before the next comes by itself where the plan has no pause; none: it waits to be asked for.
  void setOwnPause(std::function<std::optional<double>()> ownPause) { ownPause_ = std::move(ownPause); }
  /// Of the block that is open or, once that is done, of the next; empty: none.
  QString instructions();
  void note(const QString& text);
  void endRun();
  void pointTo(const Vec3& place, qint64 eventMs);
  /// Looks at the newest state. From the frame timer.
  void poll();
  /// The oldest point of the trace not yet taken.
  bool tryTake(plot::TracePoint& point) { return trace_.tryTake(point); }
  /// Which mass the trace tells of besides the hand and the last; -1: the hand.
  void watch(int mass) { trace_.watch(mass); }

  session::RecordedRun* run() { return recorded_ ? recorded_->run() : nullptr; }  // null: none is open
  /// Blocks of the plan after the one that is open.
  std::size_t blocksLeft() const { return recorded_ && isPlan() ? recorded_->blocksLeft() : 0; }
  /// Of the plan, as this session does them.
  std::size_t blockCount() { return run() != nullptr ? static_cast<std::size_t>(run()->configuration().block) + blocksLeft() : 0; }
  bool underWay() { return run() != nullptr && (run()->underWay() || isArming()); }
  /// One of several stations, by its setup; null: a window on its own.
  const network::StationSetup* station() const { return setup_ ? &*setup_ : nullptr; }
  /// Puts up what the conductor arms, and nothing else.
  bool follows() const { return setup_ && !setup_->link.conductor; }
  /// No hand is here: the window shows what the stations do.
  bool observes() const { return setup_ && setup_->link.station == 0; }
  /// What it shows; null: nothing has come yet, or a hand is here.
  const haptics::TickState* seen() const { return observer_ ? observer_->state() : nullptr; }
  /// A trial is to be armed, and is not yet.
  bool isArming() { return station_ && station_->isArming(); }
  /// How the other stations stand to this one; empty while no run is open.
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
  /// Worth a word, and no fault; sentences, a line each.
  void told(const QString& sentence);
  /// Of the other stations: how they ended a trial, who was silent.
  void stationTold(const QString& line);

 private:
  void openRun(const session::SessionRequest& request);
  void planRuns(const session::SessionRequest& request);
  void tellStation(const network::StationNews& news);
  void observe();
  void tellOpened();
  void showBlock(const session::SessionRequest& request);
  std::unique_ptr<haptics::HapticDevice> makeDeviceHere(const std::string& spec, const experiment::CompiledExperiment& experiment,
                                                        std::uint64_t seed);
  void fail(const std::exception& fault);
  std::optional<std::string> putInOrder();
  void tellTiming();
  void tellInstruments();
  void tellBackup();
  void endOnSignal(const std::stop_token& over);
  void keepStation();
  void stopInOrder();

  session::Programme programme_;
  experiment::CompiledExperiment shown_;
  bool endAfterTrial_ = false, resume_ = false;
  bool timingTold_ = false;                // of the run that is open
  std::optional<StopRequest> stop_;        // while a run is open a signal ends its trial first; at other times the program, at once
  QStringList onOpening_;                  // what is to be said of the run that is being opened, all at once
  bool numberUsed_ = false;                // the run number that was asked for holds for one run
  session::SessionRequest asked_;          // what `recorded_` was planned for
  devices::MouseDevice* mouse_ = nullptr;  // inside the run that is open
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
  // held by whoever changes the run that is open or looks whether there is one: the window, or the thread below
  std::mutex changing_;
  std::jthread endsOnSignal_;  // last: it looks at all of the above
};

/// What is worth a word before a session, as the window says it; empty: nothing.
QString wordsOf(const session::SessionNotice& notice);

}  // namespace reachlab::gui::app
