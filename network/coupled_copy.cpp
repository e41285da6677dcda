#include "network/coupled_copy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/ticks.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {
namespace {

constexpr double kLoopTicks = 0.003;    // [s] that the ticks at both ends add to the round trip
constexpr double kRoundTripMemory = 1;  // [s]
constexpr double kFirstWord = 0.25;     // [s] beyond which a peer is late that has said nothing yet in this trial
constexpr double kFrequencySlope = 1;   // [rad/s] a second: a synchronisation that jumps is felt

// The experiment with this station's hand first, the others in their order.
experiment::Experiment ownHandFirst(const experiment::Experiment& experiment, int own) {
  const int count = static_cast<int>(experiment.hands.size());
  if (count < 2) throw RefusedError("stations move one object together: the experiment needs hands, one for each station");
  if (own < 0 || own >= count) throw RefusedError(fmt::format("this station has hand {} of an experiment of {} hands", own + 1, count));
  experiment::Experiment reordered = experiment;
  std::rotate(reordered.hands.begin(), reordered.hands.begin() + own, reordered.hands.begin() + own + 1);
  return reordered;
}

}  // namespace

CopySettings copySettingsFor(const experiment::Experiment& experiment) {
  CopySettings settings;
  settings.frequency = experiment.object.kind == experiment::ObjectKind::Chain ? 3 : 1;
  return settings;
}

double synchronisationLimit(const CopySettings& settings, double roundTrip) noexcept {
  return settings.loopShare / (roundTrip + kLoopTicks);
}

CoupledCopy::CoupledCopy(const experiment::Experiment& experiment, const constraints::Constraint& constraint, int own,
                         const CopySettings& settings)
    : settings_(settings), plant_(dynamics::makeSharedPlant(ownHandFirst(experiment, own), constraint)),
      peers_(experiment.hands.size() - 1), past_(kHistory) {
  if (plant_->placeCount() > kMaxCoordinates)
    throw RefusedError(
        fmt::format("an object that stations share has up to {} coordinates, and this one has {}", kMaxCoordinates, plant_->placeCount()));
}

// What is known of the link outlasts a trial.
void CoupledCopy::resetPeers() noexcept {
  for (Peer& peer : peers_) {
    const PeerLink before = peer.link;
    peer.newest = {};
    peer.link = {};
    peer.link.roundTrip = before.roundTrip, peer.link.usualAge = before.usualAge;
    peer.link.frequency = settings_.frequency;
    peer.link.taken = before.taken, peer.link.old = before.old, peer.link.loss = before.loss;
    peer.count = {};
    peer.held = false;
  }
  for (Past& past : past_) past.time = -1;
  begun_ = false;
  ledger_ = 0;
}

void CoupledCopy::place(std::span<const double> q, std::span<const double> qRate) noexcept {
  plant_->place(q, qRate);
  resetPeers();
}

void CoupledCopy::noteAge(Peer& peer, double age) noexcept {
  peer.ages[static_cast<std::size_t>(peer.ageCount++ % kAges)] = age;
  const int known = std::min(peer.ageCount, kAges);
  if (known < kAges && known != 1 && known % 8 != 0) return;
  if (known == kAges && peer.ageCount % 32 != 0) return;
  std::array<double, kAges> sorted = peer.ages;
  std::nth_element(sorted.begin(), sorted.begin() + known / 2, sorted.begin() + known);
  peer.link.usualAge = sorted[static_cast<std::size_t>(known / 2)];
}

void CoupledCopy::noteLoss(Peer& peer, std::uint32_t sequence) noexcept {
  constexpr double kSecond = 1;
  Peer::Count& count = peer.count;
  if (count.came == 0) count.first = sequence, count.since = now_;
  else count.stride = std::min(count.stride, sequence - count.last);
  count.last = sequence;
  ++count.came;
  if (now_ - count.since < kSecond || count.came < 2) return;
  peer.link.loss = 1 - (count.came - 1) / (static_cast<double>(count.last - count.first) / count.stride);
  count = {now_, sequence, sequence, 0xffffffff, 1};
}

void CoupledCopy::setFrequency(double frequency) noexcept {
  settings_.frequency = frequency;
  for (Peer& peer : peers_) peer.link.frequency = std::min(frequency, synchronisationLimit(settings_, peer.link.roundTrip));
}

void CoupledCopy::take(int index, const CopySample& sample, double roundTrip) noexcept {
  Peer& peer = peers_[static_cast<std::size_t>(index)];
  if (peer.link.heard && static_cast<std::int32_t>(sample.sequence - peer.newest.sequence) <= 0) {
    ++peer.link.old;
    return;
  }
  ++peer.link.taken;
  peer.newest = sample;
  peer.link.heard = true;
  noteAge(peer, now_ - sample.time);
  noteLoss(peer, sample.sequence);
  if (roundTrip < 0) return;
  peer.link.roundTrip += (peer.link.roundTrip == 0 ? 1 : kTickSeconds / kRoundTripMemory) * (roundTrip - peer.link.roundTrip);
}

void CoupledCopy::breakOff(int peer) noexcept {
  if (peer >= 0 && peer < peerCount()) peers_[static_cast<std::size_t>(peer)].link.lost = true;
}

bool CoupledCopy::anyLost() const noexcept {
  return std::any_of(peers_.begin(), peers_.end(), [](const Peer& peer) { return peer.link.lost; });
}

void CoupledCopy::updateLink(Peer& peer, double dt) noexcept {
  PeerLink& link = peer.link;
  link.age = now_ - (link.heard ? peer.newest.time : peer.silentSince);
  const double silence = link.age - (link.heard ? link.usualAge : std::max(link.usualAge, kFirstWord)) - settings_.fadeAfter;
  link.fade = link.lost ? 0 : std::clamp(1 - silence / settings_.fadeDuration, 0.0, 1.0);
  if (link.fade <= 0) link.lost = true;
  if (!link.heard) link.fade = 0;
  const double wanted = std::min(settings_.frequency, synchronisationLimit(settings_, link.roundTrip));
  if (!begun_) link.frequency = wanted;
  else link.frequency += std::clamp(wanted - link.frequency, -kFrequencySlope * dt, kFrequencySlope * dt);
}

// Over the step the hand goes straight from where it was taken to be to where it is now.
void CoupledCopy::guessHand(Peer& peer, int hand) noexcept {
  const double ahead = std::clamp(peer.link.age, 0.0, settings_.mostGuessed);
  const dynamics::HandSample end{peer.newest.hand + ahead * peer.newest.handVelocity, peer.newest.handVelocity, true};
  plant_->setHand(hand, dynamics::straightSegment(peer.held ? peer.guessed : end, end), end, peer.link.fade);
  peer.guessed = end;
  peer.held = peer.link.heard;  // before its first sample its place is not known
}

double CoupledCopy::apartAt(const CopySample& sample) const noexcept {
  const long ago = std::clamp(std::lround((now_ - sample.time) / kTickSeconds), 0l, static_cast<long>(kHistory) - 1);
  const Past& past = past_[static_cast<std::size_t>((pastAt_ - 1 - ago + 2 * kHistory) % kHistory)];
  if (past.time < 0) return 0;
  const auto count = static_cast<std::size_t>(plant_->placeCount());
  return plant_->distanceBetween({past.places.data(), count}, {sample.places.data(), count});
}

void CoupledCopy::synchronise() noexcept {
  const auto rates = static_cast<std::size_t>(plant_->rateCount()), places = static_cast<std::size_t>(plant_->placeCount());
  const std::span<double> push(push_.data(), rates), difference(difference_.data(), rates);
  std::fill(push.begin(), push.end(), 0.0);
  double put = plant_->work(0);
  bool allHeard = true;
  for (const Peer& peer : peers_) {
    put += peer.newest.work;
    allHeard = allHeard && peer.link.heard;
    if (peer.link.fade <= 0) continue;
    plant_->difference({peer.newest.places.data(), places}, difference);
    const double omega = peer.link.frequency, share = peer.link.fade / static_cast<double>(peers_.size());
    for (std::size_t i = 0; i < rates; ++i)
      push[i] += share * (omega * omega * difference[i] + 2 * omega * (peer.newest.rates[i] - plant_->rates()[i]));
  }
  ledger_ = put - plant_->objectEnergy();
  if (settings_.ledger && allHeard && ledger_ < 0) {
    constexpr double kRest = 1e-9;  // [J] of a copy that hardly moves
    const double twiceKinetic = std::max(2 * plant_->kineticEnergy(), kRest);
    const double alpha = std::min(settings_.ledgerMost, -ledger_ / (settings_.ledgerTime * twiceKinetic));
    for (std::size_t i = 0; i < rates; ++i) push[i] -= alpha * plant_->rates()[i];
  }
  plant_->setExtraAcceleration(push);
}

void CoupledCopy::remember() noexcept {
  Past& past = past_[static_cast<std::size_t>(pastAt_)];
  pastAt_ = (pastAt_ + 1) % kHistory;
  past.time = now_;
  std::copy(plant_->places().begin(), plant_->places().end(), past.places.begin());
}

dynamics::StepStatus CoupledCopy::step(const dynamics::HandSegment& hand, double dt) noexcept {
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    Peer& peer = peers_[i];
    if (!begun_) peer.silentSince = now_ - dt;
    updateLink(peer, dt);
    guessHand(peer, static_cast<int>(i) + 1);
  }
  begun_ = true;
  synchronise();
  const dynamics::StepStatus status = plant_->step(hand, dt);
  remember();
  for (Peer& peer : peers_)
    if (peer.link.heard) peer.link.apart = apartAt(peer.newest);
  if (status == dynamics::StepStatus::Ok && anyLost()) return dynamics::StepStatus::PeerLost;
  return status;
}

void CoupledCopy::fill(CopySample& sample, const dynamics::HandSample& hand) const noexcept {
  sample.hand = hand.position;
  sample.handVelocity = hand.velocity;
  sample.work = plant_->work(0);
  std::copy(plant_->places().begin(), plant_->places().end(), sample.places.begin());
  std::copy(plant_->rates().begin(), plant_->rates().end(), sample.rates.begin());
}

}  // namespace reachlab::network
