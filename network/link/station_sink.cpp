#include "network/link/station_sink.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/ticks.h"
#include "sim/trial/protocol.h"

namespace reachlab::network {

std::uint64_t StationSink::repeatedNow() const noexcept {
  std::uint64_t all = 0;
  for (int i = 0; i < copy_.peerCount(); ++i) all += copy_.link(i).old;
  return all;
}

bool StationSink::give(const GivenSample& given) noexcept {
  if (given_->tryPush(given)) return true;
  memory_.ringsFull.fetch_add(1, std::memory_order_relaxed);
  return false;
}

// What cannot be kept in the log is not done yet: the copy must be the same when it is computed again.
void StationSink::giveOrders(const haptics::TickState& state, std::int32_t trial) noexcept {
  if (const double wanted = frequency_.load(std::memory_order_acquire); wanted != frequencyNow_) {
    const GivenSample order{state.tick, GivenSample::kFrequency, wanted, {}};
    if (given_->tryPush(order)) frequencyNow_ = wanted, order.giveTo(copy_);
  }
  std::int64_t broken = brokenOff_.load(std::memory_order_acquire);
  if (broken == 0) return;
  const auto of = static_cast<std::int32_t>(broken >> 8);
  if (of == trial) {
    if (!trial::isEngaged(state.phase)) return;  // it will be lost as soon as the hands hold the object
    const GivenSample order{state.tick, GivenSample::kBrokenOff, static_cast<double>(broken & 0xff), {}};
    if (!given_->tryPush(order)) return;
    order.giveTo(copy_);
  } else if (of > trial) {
    return;
  }
  brokenOff_.compare_exchange_strong(broken, 0, std::memory_order_acq_rel);
}

void StationSink::noteApart(const haptics::TickState& state) noexcept {
  if (state.trial != trial_) {
    trial_ = state.trial;
    squares_ = 0, count_ = 0;
    towards_ = {};
    repeatedBefore_ = repeatedNow();
  }
  if (trial::isEngaged(state.phase)) {
    towards_.lastApart = 0;
    bool faded = false;
    for (int i = 0; i < copy_.peerCount(); ++i) {
      const PeerLink& link = copy_.link(i);
      towards_.lastApart = std::max(towards_.lastApart, link.apart);
      towards_.oldest = std::max(towards_.oldest, link.age);
      faded = faded || (link.heard && link.age > 0 && link.fade < 1);  // age 0: not stepped yet
    }
    if (faded) ++towards_.fadedTicks;
    squares_ += towards_.lastApart * towards_.lastApart, ++count_;
    towards_.mostApart = std::max(towards_.mostApart, towards_.lastApart);
    towards_.rmsApart = std::sqrt(squares_ / static_cast<double>(count_));
    towards_.repeated = repeatedNow() - repeatedBefore_;
  }
  toldTowards_.publish(towards_);
}

void StationSink::takeHeard(const haptics::TickState& state, std::int32_t trial, bool gives) noexcept {
  HeardState heard;
  bool came = false;
  for (int peer = 0; peer < copy_.peerCount(); ++peer) {
    const auto station = static_cast<std::size_t>(peer < own_ ? peer : peer + 1);
    while (memory_.in[station].tryPop(heard)) {
      seen_.place[station] = heard.sample.hand;
      seen_.known[station] = came = true;
      if (!gives || heard.trial != trial || trial < 1) continue;
      const GivenSample given{state.tick, peer, heard.roundTrip, heard.sample};
      if (give(given)) given.giveTo(copy_);  // what the log cannot keep did not come
    }
  }
  if (came) hands_.publish(seen_);
}

void StationSink::send(const haptics::TickState& state, std::int32_t trial) noexcept {
  OwnState own;
  own.timeNs = state.measuredNs;
  own.trial = trial;
  own.phase = static_cast<std::uint8_t>(state.phase);
  own.places = places_, own.rates = rates_;
  own.sample.sequence = ++sequence_;
  // Before it is armed a hand holds nothing: for the others it is where it will hold.
  const bool armed = state.phase == trial::Phase::Armed || state.phase == trial::Phase::Moving || state.phase == trial::Phase::Done;
  copy_.fill(own.sample, armed ? state.hands[0].hip : dynamics::HandSample{copy_.ownFixedPoint(), {}, true});
  if (state.tick % static_cast<std::uint64_t>(sendEvery_) != 0) return;
  if (!memory_.out.tryPush(own)) memory_.ringsFull.fetch_add(1, std::memory_order_relaxed);
}

bool StationSink::onTick(const haptics::TickState& state, trial::Command, std::uint32_t) noexcept {
  const std::int32_t trial = state.trial < 1 ? state.trial : state.trial + trialsBefore_.load(std::memory_order_acquire);
  const bool gives = !givesNoMore_.load(std::memory_order_acquire);
  if (!gives) gaveLast_.store(true, std::memory_order_release);
  fillLinks(copy_, links_.data());
  noteApart(state);
  copy_.beginTick(timeAfter(state));
  if (gives) giveOrders(state, trial);
  takeHeard(state, trial, gives);
  send(state, trial);
  return true;
}

std::vector<std::uint8_t> StationSink::takeGiven() {
  GivenRecord record{own_, places_, rates_, {}};
  GivenSample given;
  // No more than the ring holds, so that this ends even where the haptic thread gives faster.
  while (record.samples.size() < kGivenRoom && given_->tryPop(given)) record.samples.push_back(given);
  if (std::exchange(said_, true) && record.samples.empty()) return {};
  return encodeGiven(std::move(record));
}

const TowardsOthers& StationSink::towardsOthers() noexcept {
  if (const TowardsOthers* newest = toldTowards_.takeLatest()) knownTowards_ = *newest;
  return knownTowards_;
}

double timeAfter(const haptics::TickState& state) noexcept { return static_cast<double>(state.measuredNs + kTickNs) * 1e-9; }

}  // namespace reachlab::network
