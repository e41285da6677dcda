#include "sim/session/recorded_session.h"

#include <chrono>
#include <thread>

namespace reachlab::session {
namespace {

// The haptic loop goes on meanwhile.
template <typename IsOver>
void waitUntil(IsOver&& isOver, const std::atomic<bool>& stop) {
  while (!stop && !isOver(std::chrono::steady_clock::now())) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

// Says at times that the trial which is up waits for its hand.
std::optional<haptics::ConductedTrial> runTrial(RecordedRun& run, const std::atomic<bool>& stop, const SessionWords& words) {
  if (!words.waiting) return run.runTrial(stop);
  constexpr std::chrono::seconds kFirst{3}, kAgain{10};
  return run.runTrial(stop, [&, due = std::chrono::steady_clock::now() + kFirst]() mutable {
    const auto now = std::chrono::steady_clock::now();
    if (run.latest().phase != trial::Phase::Waiting || now < due) return;
    due = now + kAgain;
    words.waiting(run);
  });
}

// True when it was done to its end.
bool conductRun(RecordedSession& session, const std::atomic<bool>& stop, const SessionWords& words) {
  RecordedRun& run = *session.run();
  run.checkTiming(stop);
  if (run.timingVerdict() && words.checked) words.checked(run);
  while (const std::optional<haptics::ConductedTrial> trial = runTrial(run, stop, words)) {
    words.ended(run, *trial);
    if (trial::endsRun(trial->result) || run.fault()) return false;
    session.trialEnded(std::chrono::steady_clock::now(), 0);
    if (run.trialsLeft() > 0) waitUntil([&](Pacing::Time now) { return session.pacing().takeNextTrial(now); }, stop);
    if (stop) return false;
  }
  return !stop;
}

}  // namespace

RecordedSession::RecordedSession(const Programme& programme, const SessionRequest& request, DeviceMaker makeDevice,
                                 haptics::RunSink* watcher, record::InstrumentLink* instruments)
    : request_(request), makeDevice_(std::move(makeDevice)), watcher_(watcher), instruments_(instruments),
      session_(planSession(request, programme)) {}

bool RecordedSession::openNext() {
  closeRun();
  if (session_.blocks.empty()) return false;
  pacing_ = {};
  const BlockToRun& block = session_.blocks.front();
  RecordedRunOptions options;
  options.place = request_.place;
  options.numberAskedFor = request_.run == block.configuration.run;
  options.virtualClock = request_.fast;
  options.diskReserve = request_.diskReserve;
  options.timingCheckSeconds = request_.timingCheckSeconds;
  if (watcher_ != nullptr) options.watchers.push_back(watcher_);
  options.instruments = instruments_;
  if (prepare_) prepare_(options);
  run_ = std::make_unique<RecordedRun>(block, makeDevice_(request_.device, block.scenes, block.configuration.seed), options);
  session_.blocks.pop_front();
  return true;
}

void RecordedSession::closeRun() {
  if (const std::unique_ptr<RecordedRun> ending = std::move(run_)) ending->finish();
}

void RecordedSession::trialEnded(Pacing::Time now, std::optional<double> ownPause) {
  const auto unlessFast = [this](double seconds) { return request_.fast ? 0 : seconds; };
  if (run_->trialsLeft() > 0) {
    const double planned = run_->configuration().pauseSeconds;
    if (planned > 0 || ownPause) pacing_.pauseFor(unlessFast(planned > 0 ? planned : *ownPause), now);
  } else if (!session_.blocks.empty() && unlessFast(session_.blocks.front().restSeconds) > 0) {
    pacing_.restFor(session_.blocks.front().restSeconds, now);
  }
}

bool conduct(RecordedSession& session, const std::atomic<bool>& stop, const SessionWords& words) {
  while (session.nextBlock() != nullptr) {
    if (stop) return false;  // while the tables of the block before were written
    if (session.pacing().rests()) {
      if (words.resting) words.resting(*session.nextBlock());
      waitUntil([&](Pacing::Time now) { return session.pacing().restLeft(now) == 0; }, stop);
      if (stop) return false;
    }
    session.openNext();
    RecordedRun& run = *session.run();
    words.opened(run);
    const bool toItsEnd = conductRun(session, stop, words);
    run.closeLog();
    words.logClosed(run);
    const std::optional<std::string> fault = run.fault();
    session.closeRun();
    words.closed();
    if (fault) throw ResourceError(*fault);
    if (!toItsEnd) return false;
  }
  return true;
}

}  // namespace reachlab::session
