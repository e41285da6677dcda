#include "sim/session/recorded_session.h"

#include <chrono>
#include <thread>
#include <utility>

namespace reachlab::session {
namespace {

// The pause between trials; the haptic loop goes on meanwhile.
void pauseFor(double seconds, const std::atomic<bool>& stop) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!stop && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

// Says at times that the trial which is up waits for its hand.
class Wait {
 public:
  Wait(const RecordedRun& run, const SessionWords& words) : run_(run), words_(words) {}
  void look() {
    const auto now = std::chrono::steady_clock::now();
    if (run_.latest().phase != trial::Phase::Waiting || now < due_) return;
    due_ = now + kAgain;
    words_.waiting(run_);
  }

 private:
  static constexpr std::chrono::seconds kFirst{3}, kAgain{10};
  const RecordedRun& run_;
  const SessionWords& words_;
  std::chrono::steady_clock::time_point due_ = std::chrono::steady_clock::now() + kFirst;
};

std::optional<haptics::ConductedTrial> runTrial(RecordedRun& run, const std::atomic<bool>& stop, const SessionWords& words) {
  if (!words.waiting) return run.runTrial(stop);
  Wait wait(run, words);
  return run.runTrial(stop, [&wait] { wait.look(); });
}

// True when it was done to its end.
bool conduct(RecordedRun& run, bool virtualClock, const std::atomic<bool>& stop, const SessionWords& words) {
  run.checkTiming(stop);
  if (run.timingVerdict() && words.checked) words.checked(run);
  while (const std::optional<haptics::ConductedTrial> trial = runTrial(run, stop, words)) {
    words.ended(run, *trial);
    if (trial::endsRun(trial->result) || run.fault()) return false;
    if (!virtualClock && run.trialsLeft() > 0) pauseFor(run.configuration().pauseSeconds, stop);
    if (stop) return false;
  }
  return true;
}

}  // namespace

RecordedSession::RecordedSession(const Programme& programme, const SessionRequest& request, DeviceMaker makeDevice,
                                 haptics::RunSink* watcher, record::InstrumentLink* instruments)
    : request_(request), makeDevice_(std::move(makeDevice)), watcher_(watcher), instruments_(instruments) {
  SessionToRun session = planSession(request, programme);
  notice_ = session.notice;
  seed_ = session.seed;
  blocks_.assign(std::make_move_iterator(session.blocks.begin()), std::make_move_iterator(session.blocks.end()));
}

bool RecordedSession::openNext() {
  closeRun();
  if (blocks_.empty()) return false;
  const BlockToRun& block = blocks_.front();
  RecordedRunOptions options;
  options.place = request_.place;
  options.numberAskedFor = request_.run == block.configuration.run;
  options.virtualClock = request_.fast;
  options.diskReserve = request_.diskReserve;
  options.timingCheckSeconds = request_.timingCheckSeconds;
  if (watcher_ != nullptr) options.watchers.push_back(watcher_);
  options.instruments = instruments_;
  if (prepare_) prepare_(options);
  run_ = std::make_unique<RecordedRun>(block, makeDevice_(request_.device, block.experiment, block.configuration.seed), options);
  blocks_.pop_front();
  return true;
}

void RecordedSession::closeRun() {
  if (const std::unique_ptr<RecordedRun> ending = std::move(run_)) ending->finish();
}

bool conduct(RecordedSession& session, const std::atomic<bool>& stop, const SessionWords& words) {
  bool first = true;
  while (session.nextBlock() != nullptr) {
    const BlockToRun& next = *session.nextBlock();
    if (!std::exchange(first, false) && next.restSeconds > 0 && !session.isFast()) {
      if (words.resting) words.resting(next);
      pauseFor(next.restSeconds, stop);
      if (stop) return false;
    }
    session.openNext();
    RecordedRun& run = *session.run();
    words.opened(run);
    const bool toItsEnd = conduct(run, run.configuration().clock == "virtual", stop, words);
    run.closeLog();
    words.logClosed(run);
    const std::optional<std::string> fault = run.fault();
    run.finish();
    words.closed(run);
    if (fault) throw ResourceError(*fault);
    if (!toItsEnd) return false;
  }
  session.closeRun();
  return true;
}

}  // namespace reachlab::session
