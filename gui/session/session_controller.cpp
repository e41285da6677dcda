#include "gui/session/session_controller.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "constraints/geometry/task_path.h"
#include "base/terminal/message.h"
#include "devices/instruments/instruments.h"
#include "devices/kept_mapping.h"
#include "devices/make_device.h"
#include "devices/mouse/mouse_device.h"
#include "devices/preflight/preflight.h"
#include "gui/widgets/fault_in.h"
#include "gui/widgets/fault_words.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/file_text.h"
#include "sim/trial/protocol.h"
#include "sim/trial/task_check.h"

namespace reachlab::gui::app {
namespace {

// The experiment that is shown before anything is run: of a plan that of the block that this subject does first.
experiment::CompiledExperiment firstExperiment(const session::Programme& programme, const session::SessionRequest& request) {
  if (!programme.isPlan()) return programme.experiments.front();
  const session::SessionToRun session = session::planSession(request, programme);
  if (session.blocks.empty()) return programme.experiments.front();
  const session::BlockToRun& first = session.blocks.front();
  return first.scenes.at(static_cast<std::size_t>(first.trials.front().scene));
}

// Another subject, session, day or folder is another session.
bool isSameSession(const session::SessionRequest& a, const session::SessionRequest& b) { return a.place == b.place && a.day == b.day; }

}  // namespace

SessionController::SessionController(const session::SessionRequest& request, std::optional<network::StationSetup> station, QObject* parent)
    : QObject(parent), programme_(session::readProgramme(request.what)), shown_(firstExperiment(programme_, request)),
      resume_(request.resume), asked_(request), setup_(std::move(station)),
      endsOnSignal_([this](const std::stop_token& over) { endOnSignal(over); }) {
  if (setup_) (void)session::experimentOfStations(programme_);
}

SessionController::~SessionController() {
  const std::scoped_lock lock(changing_);
  (void)putInOrder();  // nobody is left to be told
}

// First what cannot be done again: zero force, the trial marked, the log closed. What went wrong, in a sentence. With `changing_` held.
QString SessionController::putInOrder() {
  if (run() == nullptr) return {};
  return widgets::faultIn([this] {
    if (station_) (void)station_->close();
    else run()->closeLog();
    stop_->allInOrder();
  });
}

void SessionController::setProgramme(const session::Programme& programme) {
  programme_ = programme;
  const bool observed = observer_ != nullptr;
  observer_.reset();  // of another experiment
  try {
    shown_ = firstExperiment(programme, asked_);
  } catch (const Error&) {  // the plan has nothing for this subject and day: that is said when a run is to be opened
    shown_ = programme.experiments.front();
  }
  endRun();  // before the new scene is shown, so that no trial is judged by another scene
  {
    const std::scoped_lock lock(changing_);
    recorded_.reset();  // what is to be done next is another
  }
  Q_EMIT experimentChanged();
  if (!observed) return;
  if (const QString fault = widgets::faultIn([this] { join(asked_); }); !fault.isEmpty()) Q_EMIT failed(fault);
}

std::vector<Fault> SessionController::tryEdit(const experiment::Experiment& experiment) {
  experiment::Experiment edited = experiment;
  edited.text = fileText(edited);
  try {
    const experiment::CompiledExperiment compiled(edited);
    const session::Programme programme = session::programmeOf(compiled);
    if (compiled.experiment().task)
      if (std::vector<Fault> faults = trial::taskProblems(compiled); !faults.empty()) return faults;
    setProgramme(programme);
    return {};
  } catch (const FaultError& error) {
    return error.faults;
  }
}

std::unique_ptr<haptics::HapticDevice> SessionController::makeDeviceHere(const std::string& spec,
                                                                         std::span<const experiment::CompiledExperiment> scenes,
                                                                         std::uint64_t seed) {
  mouse_ = nullptr;
  if (spec != "mouse") {
    auto device = devices::makeDevice(spec, scenes, station_ ? station_->seedHere(seed) : seed, &learnt_);
    for (const std::string& sentence : devices::warningsBeforeBlock(scenes, *device)) onOpening_ << QString::fromStdString(sentence);
    return device;
  }
  const experiment::CompiledExperiment& experiment = scenes.front();
  auto mouse = std::make_unique<devices::MouseDevice>(trial::makeProtocolSettings(experiment.experiment(), experiment.constraint()).start);
  mouse_ = mouse.get();
  return mouse;
}

void SessionController::planRuns(const session::SessionRequest& request) {
  session::SessionRequest asked = request;
  asked.resume = resume_;
  if (resume_ && asked.trials) asked.trialsOnOffer = *std::exchange(asked.trials, std::nullopt);  // what is recorded has its own number
  if (numberUsed_) asked.run.reset();
  if (follows()) asked.trials = 1;  // the conductor's count holds
  std::vector<std::string> mappings;
  asked.device = devices::withKeptMappings(asked.device, asked.place.data, asked.place.subject, mappings);
  for (const std::string& file : mappings) onOpening_ << tr("The mapping of the hand is read from %1.").arg(QString::fromStdString(file));
  if (!instruments_) instruments_ = devices::openInstruments(request.instruments);
  auto planned = std::make_unique<session::RecordedSession>(
      programme_, asked, [this](const auto& spec, auto scenes, auto seed) { return makeDeviceHere(spec, scenes, seed); }, &trace_,
      instruments_.get());
  if (planned->blocksLeft() == 0) {
    resume_ = false;
    throw FaultError(Fault{{}, "nothing is left to do: every trial of this session is recorded", "another subject or session"});
  }
  recorded_ = std::move(planned);
  asked_ = request;
  learnt_.reset();
  resume_ = false;
  if (recorded_->notice().unfinished)
    onOpening_ << "An earlier run of this session is not finished. Trial, Resume continues it. This is a new run.";
  if (recorded_->notice().again)
    onOpening_ << "This session has blocks of this plan already, and they are recorded again. Trial, Resume continues after them.";
  if (recorded_->notice().nothingToResume)
    onOpening_ << "Nothing that this session asks for is recorded yet, so there was nothing to resume. It begins.";
  for (const std::string& sentence : recorded_->notice().leftOut) onOpening_ << QString::fromStdString(sentence);
}

void SessionController::openRun(const session::SessionRequest& request) {
  const std::scoped_lock lock(changing_);
  onOpening_.clear();
  if (!recorded_ || !isPlan() || !isSameSession(request, asked_)) planRuns(request);
  if (setup_) {
    setup_->link.device = request.device;
    station_ = std::make_unique<network::StationRun>(*setup_, session::experimentOfStations(programme_));
    recorded_->prepareRuns([this](session::RecordedRunOptions& options) { station_->prepare(options); });
  }
  const bool opened = recorded_->openNext();
  if (opened)
    for (const Fault& warning : run()->warnings()) onOpening_ << widgets::inWords(warning);
  if (!onOpening_.isEmpty()) Q_EMIT told(onOpening_.join(QLatin1Char('\n')));
  if (!opened) return;
  if (station_) station_->begin(*run());
  stop_.emplace();
  timingTold_ = false;
  numberUsed_ = true;
  for (plot::TracePoint left; trace_.tryTake(left);) {}  // of the run before
  last_.reset();
}

void SessionController::planAnew(bool resume) {
  const std::scoped_lock lock(changing_);
  if (run() != nullptr) return;
  recorded_.reset();  // planned from what is on the disk
  resume_ = resume;
}

void SessionController::resume(const session::SessionRequest& request) {
  planAnew(true);
  asked_ = request;
  asked_.resume = true;
}

double SessionController::restLeft() const { return recorded_ ? recorded_->pacing().restLeft(std::chrono::steady_clock::now()) : 0; }

bool SessionController::takeNextTrial() { return recorded_ && recorded_->pacing().takeNextTrial(std::chrono::steady_clock::now()); }

void SessionController::cancelPause() {
  if (recorded_) recorded_->pacing().cancelPause();
}

QString SessionController::instructions() {
  if (run() == nullptr) return {};
  if (run()->underWay() || run()->trialsLeft() > 0) return QString::fromStdString(run()->instructions());
  const session::BlockToRun* next = isPlan() ? recorded_->nextBlock() : nullptr;
  return next == nullptr ? QString() : QString::fromStdString(next->instructions);
}

void SessionController::join(const session::SessionRequest& request) {
  if (run() != nullptr) return;
  if (observes()) {
    const std::scoped_lock lock(changing_);
    if (!observer_) observer_ = std::make_unique<network::Observer>(*setup_, shown_);
    return;
  }
  openRun(request);
  if (run() == nullptr) return;
  if (isPlan()) {
    shown_ = run()->experimentNow();
    Q_EMIT experimentChanged();
  }
  Q_EMIT runOpened();
}

bool SessionController::next(const session::SessionRequest& request) {
  if (underWay()) return false;
  if (observes()) throw FaultError(Fault{"station", "only observes", "a station's number, to take part"});
  if (run() != nullptr && run()->trialsLeft() == 0 && !follows()) {
    endRun();
    if (isPlan() && recorded_->blocksLeft() == 0) return false;
  }
  join(request);
  {
    const std::scoped_lock lock(changing_);
    if (station_) {
      station_->armNext();
      return true;
    }
    if (run() == nullptr || !run()->putUpNext()) return false;
  }
  showScene();
  Q_EMIT trialBegun();
  return true;
}

// A trial of another kind, or to another target.
void SessionController::showScene() {
  const experiment::CompiledExperiment& now = run()->experimentNow();
  if (!isPlan() || &now.experiment() == &shown_.experiment()) return;
  shown_ = now;
  Q_EMIT experimentChanged();
}

const std::vector<session::BlockScene>* SessionController::shownScenes() const {
  const auto isShown = [&](const experiment::CompiledExperiment& e) { return &e.experiment() == &shown_.experiment(); };
  for (std::size_t block = 0; block < programme_.scenes.size(); ++block) {
    const std::vector<session::BlockScene>& scenes = programme_.scenes[block];
    if (scenes.size() > 1 && (isShown(programme_.experiments[block]) ||
                              std::any_of(scenes.begin(), scenes.end(), [&](const auto& scene) { return isShown(scene.experiment); })))
      return &scenes;
  }
  return nullptr;
}

std::vector<Vec3> SessionController::blockPlaces() const {
  std::vector<Vec3> places;
  const std::vector<session::BlockScene>* scenes = shownScenes();
  if (scenes == nullptr) return places;
  for (const session::BlockScene& scene : *scenes)
    for (const std::vector<double>& q : {scene.experiment.experiment().task->start, scene.experiment.experiment().task->target})
      if (const Vec3 place = constraints::placeOn(scene.experiment.constraint(), q);
          isFinite(place) && std::find(places.begin(), places.end(), place) == places.end())
        places.push_back(place);
  return places;
}

void SessionController::abort() {
  const std::scoped_lock lock(changing_);
  if (station_) station_->abort();
  else if (run() != nullptr) run()->abort();
}

bool SessionController::repeat() {
  const std::scoped_lock lock(changing_);
  if (run() == nullptr || !last_ || follows()) return false;
  run()->repeat(last_->planned);
  return true;
}

bool SessionController::takeBackRepeat() {
  const std::scoped_lock lock(changing_);
  return run() != nullptr && run()->takeBackRepeat();
}

void SessionController::note(const QString& text) {
  if (run() == nullptr) return;
  fail(widgets::faultIn([&] {
    const std::scoped_lock lock(changing_);
    run()->note(text.toStdString());
  }));
}

bool SessionController::endRun() {
  if (run() == nullptr) return true;
  recorded_->pacing() = {};
  mouse_ = nullptr;
  std::unique_lock lock(changing_);
  const bool unfinished = run()->trialsLeft() > 0;
  const QString log = QString::fromStdString(run()->logPath());
  QStringList faults{putInOrder()};
  faults << widgets::faultIn([this] {
    const std::string dataset = asked_.place.data;
    recorded_->closeRun();
    station_.reset();
    tellInstruments();
    if (!asked_.backup.empty()) {
      if (!backup_ || backupOf_ != dataset) {
        backup_.reset();
        backup_.emplace(backupOf_ = dataset, asked_.backup);
      }
      backup_->request();
    }
  });
  faults.removeAll({});
  if (!faults.isEmpty())
    Q_EMIT failed(faults.join(QLatin1Char('\n')) +
                  tr("\nThe finished trials are safe in %1. The tables of the dataset are not complete. Remove the cause, then run: "
                     "reach export %2 --format bids")
                      .arg(log, QString::fromStdString(asked_.place.data)));
  stop_.reset();
  if (unfinished) recorded_.reset();  // the next run is planned from what counts on the disk
  lock.unlock();
  Q_EMIT runClosed();
  return faults.isEmpty();
}

void SessionController::pointTo(const Vec3& place, qint64 eventMs) {
  constexpr std::int64_t kNsPerMs = 1'000'000;
  if (mouse_ != nullptr) mouse_->point(place, eventMs * kNsPerMs);
}

void SessionController::poll() {
  if (StopRequest::asked()) return;
  tellBackup();
  if (observer_) return observe();
  if (run() == nullptr) return;
  fail(widgets::faultIn([this] {
    network::StationNews news;
    {
      const std::scoped_lock lock(changing_);
      if (station_) news = station_->poll();
      else news.ended = run()->poll();
    }
    tellTiming();
    tellStation(news);
    if (const std::optional<haptics::ConductedTrial>& ended = news.ended) {
      tellInstruments();
      last_ = *ended;
      recorded_->trialEnded(std::chrono::steady_clock::now(), ownPause_ ? ownPause_() : std::nullopt);
      Q_EMIT trialEnded();
    }
    if (news.finished && run() != nullptr) {
      endRun();
      Q_EMIT done(tr("The conductor has ended the run."));
    }
    if (!news.ended || run() == nullptr) return;
    if (const auto fault = run()->fault()) throw ResourceError(*fault);
  }));
}

void SessionController::observe() {
  const network::ObserverNews news = observer_->poll();
  for (const network::LinkEvent& event : news.ended) Q_EMIT stationTold(QString::fromStdString(network::wordsOf(event)));
  if (news.finished) Q_EMIT done(tr("The conductor has ended the run."));
  if (!news.problem.empty()) Q_EMIT told(QString::fromStdString(news.problem));
}

void SessionController::tellStation(const network::StationNews& news) {
  for (const std::string& line : news.words) Q_EMIT stationTold(QString::fromStdString(line));
  if (!news.problem.empty()) Q_EMIT told(QString::fromStdString(news.problem));
  if (news.begun) Q_EMIT trialBegun();
}

std::vector<network::StationStatus> SessionController::statuses() {
  const std::scoped_lock lock(changing_);
  if (observer_) return observer_->link().statuses();
  return station_ ? station_->link().statuses() : std::vector<network::StationStatus>();
}

network::OtherHands SessionController::otherHands() {
  const std::scoped_lock lock(changing_);
  if (observer_) return observer_->hands();
  return station_ ? station_->otherHands() : network::OtherHands();
}

// A machine that keeps time well needs no word.
void SessionController::tellTiming() {
  const auto& verdict = run()->timingVerdict();
  if (!verdict || std::exchange(timingTold_, true) || (verdict->good && verdict->realTime)) return;
  Q_EMIT told(QString::fromStdString(verdict->sentence));
}

void SessionController::tellInstruments() {
  if (!instruments_) return;
  for (const std::string& sentence : instruments_->takeWarnings()) Q_EMIT failed(QString::fromStdString(sentence));
}

// Each state once.
void SessionController::tellBackup() {
  if (!backup_) return;
  const session::BackupState state = backup_->state();
  if (std::exchange(backupTold_, state.kind) == state.kind || state.kind == session::BackupState::Kind::Idle) return;
  const QString sentence = QString::fromStdString(state.sentence);
  if (state.kind == session::BackupState::Kind::Failed) Q_EMIT failed(sentence);
  else Q_EMIT done(sentence);
}

void SessionController::endOnSignal(const std::stop_token& over) {
  constexpr auto kLook = std::chrono::milliseconds(10);
  while (!over.stop_requested() && !StopRequest::asked()) {
    std::this_thread::sleep_for(kLook);
    keepStation();
  }
  if (StopRequest::asked()) stopInOrder();
}

// What the other stations send is kept however long the window is busy: the rings hold a second or so.
void SessionController::keepStation() {
  const std::unique_lock lock(changing_, std::try_to_lock);
  if (!lock || !station_ || run() == nullptr) return;
  try {
    station_->keep();
  } catch (const Error&) {  // the disk is full: the window's next look says so
  }
}

// The window is not asked, and its objects are left as they are: it may be in the midst of anything.
void SessionController::stopInOrder() {
  const std::scoped_lock lock(changing_);
  QString wrong = putInOrder();
  if (run() != nullptr && wrong.isEmpty()) wrong = widgets::faultIn([this] { run()->finish(); });
  if (!wrong.isEmpty()) std::fputs(messageOf(wrong.toStdString()).c_str(), stderr);
  std::_Exit(StopRequest::exitCode());
}

// After a fault the run cannot go on: what was finished is on the disk, and the loop ends with zero force.
void SessionController::fail(const QString& fault) {
  if (fault.isEmpty()) return;
  mouse_ = nullptr;
  std::unique_lock lock(changing_);
  (void)putInOrder();  // the fault itself is what is told
  recorded_.reset();
  station_.reset();
  stop_.reset();
  lock.unlock();
  resume_ = isPlan();  // its other blocks are still to be done
  Q_EMIT failed(fault);
  Q_EMIT runClosed();
}

}  // namespace reachlab::gui::app
