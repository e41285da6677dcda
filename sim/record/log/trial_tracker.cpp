#include "sim/record/log/trial_tracker.h"

#include <algorithm>

namespace reachlab::record {

// Of several hands: what acts on any of them. The movement is the first hand's.
TickFacts factsOf(const haptics::TickState& state) noexcept {
  TickFacts facts{.phase = state.phase,
                  .status = state.status,
                  .trial = state.trial,
                  .deviceValid = state.hands[0].device.valid || state.hands[0].device.released,
                  .channelBroken = state.hasEnvironment && state.environment.channelBroken,
                  .hip = state.hands[0].hip,
                  .couplingForce = state.hands[0].couplingForce,
                  .result = state.result};
  for (int i = 0; i < state.handCount; ++i) {
    const haptics::HandState& hand = state.hands[static_cast<std::size_t>(i)];
    facts.clamped = facts.clamped || (hand.clamped && hand.device.valid);
    if (!hand.rendersForce) continue;
    facts.deviceState = std::max(facts.deviceState, hand.deviceState);
    facts.interventions |= hand.interventions;
  }
  return facts;
}

void TrialTracker::begin(const TickStamp& tick, std::int32_t number) {
  trial_ = beginTrial(number, number - 1, tick.tick, setups_);
  setups_.clear();
  underWay_ = true;
  phase_ = trial::Phase::Idle;
  forceSum_ = 0;
  moving_ = 0;
}

void TrialTracker::measure(const TickFacts& facts) {
  trial_.peakHandSpeed = std::max(trial_.peakHandSpeed, norm(facts.hip.velocity));
  if (moving_ > 0) trial_.handPathLength += norm(facts.hip.position - lastPosition_);
  const double force = norm(facts.couplingForce);
  trial_.peakForce = std::max(trial_.peakForce, force);
  forceSum_ += force;
  ++moving_;
  lastPosition_ = facts.hip.position;
}

// An intervention that comes and goes from tick to tick is one, until it has stayed away for kQuietTicks.
void TrialTracker::tellGuards(const TickStamp& tick, std::int32_t number, const TickFacts& facts, std::vector<RecordedEvent>& events) {
  constexpr std::uint64_t kQuietTicks = 100;
  if (facts.deviceState != deviceState_)
    events.push_back({tick.tick, EventKind::DeviceState, number, static_cast<double>(facts.deviceState),
                      std::string(haptics::nameOf(facts.deviceState))});
  deviceState_ = facts.deviceState;
  if (facts.interventions == 0 && !intervened_) return;
  intervened_ = false;
  for (int bit = 0; bit < haptics::intervention::kCount; ++bit) {
    std::uint64_t& last = lastActive_[static_cast<std::size_t>(bit)];
    const auto tell = [&](double value) {
      events.push_back({tick.tick, EventKind::Intervention, number, value, std::string(haptics::intervention::nameOf(bit))});
    };
    if ((facts.interventions >> bit & 1) != 0) {
      if (last == 0) tell(1);
      last = tick.tick;
    } else if (last != 0 && tick.tick > last + kQuietTicks) {
      tell(0);
      last = 0;
    }
    intervened_ = intervened_ || last != 0;
  }
}

TrialTracker::Step TrialTracker::add(const TickStamp& tick, const TickFacts& facts, std::vector<RecordedEvent>& events) {
  Step step;
  const std::int32_t number = facts.trial > 0 ? facts.trial + firstTrial_ - 1 : facts.trial;
  const auto tell = [&](EventKind kind, double value = 0) { events.push_back({tick.tick, kind, number, value, {}}); };
  const bool inTrial = facts.phase != trial::Phase::Idle && number > 0;
  if (inTrial && number != trial_.trial) {
    begin(tick, number);
    step.started = true;
    tell(EventKind::TrialStart, trial_.planned.index);
  }
  if (tick.missedTicks > 0) tell(EventKind::TicksMissed, tick.missedTicks);
  if (facts.deviceValid != valid_) tell(facts.deviceValid ? EventKind::DeviceBack : EventKind::DeviceLost);
  valid_ = facts.deviceValid;
  tellGuards(tick, number, facts, events);
  if (facts.clamped != clamped_) tell(facts.clamped ? EventKind::ClampBegin : EventKind::ClampEnd);
  clamped_ = facts.clamped;
  if (facts.status != status_ && facts.status != dynamics::StepStatus::Ok) tell(EventKind::StepFault, static_cast<double>(facts.status));
  status_ = facts.status;
  if (!underWay_) return step;

  if (tick.tick > trial_.lastTick + 1) trial_.droppedTicks += tick.tick - trial_.lastTick - 1;
  trial_.lastTick = tick.tick;
  trial_.missedTicks += tick.missedTicks;
  if (facts.clamped) ++trial_.clampedTicks;
  if (facts.channelBroken && !trial_.channelBroken) {
    trial_.channelBroken = true;
    tell(EventKind::ChannelBroken);
  }
  if (facts.phase != phase_) {
    if (facts.phase == trial::Phase::Armed) {
      trial_.armedTick = tick.tick;
      tell(EventKind::Armed);
    }
    if (facts.phase == trial::Phase::Moving) tell(EventKind::Onset);
  }
  const bool armed = facts.phase == trial::Phase::Armed || facts.phase == trial::Phase::Moving;
  const std::uint64_t wait = static_cast<std::uint64_t>(std::max(0, trial_.planned.foreperiodTicks));
  if (armed && trial_.armedTick > 0 && trial_.goTick == 0 && !trial_.planned.catchTrial && tick.tick >= trial_.armedTick + wait) {
    trial_.goTick = tick.tick;
    goNs_ = tick.measuredNs;
    tell(EventKind::Go);
  }
  if (facts.phase == trial::Phase::Moving) {
    trial_.result.onsetTick = moving_ == 0 ? tick.tick : trial_.result.onsetTick;
    measure(facts);
  }
  phase_ = facts.phase;
  if (facts.phase == trial::Phase::Done) {
    if (trial_.result.onsetTick > 0 && facts.result.onsetTick > 0) measure(facts);
    trial_.result = facts.result;
    trial_.meanForce = meanForce();
    if (trial_.goTick > 0) trial_.elapsed = static_cast<double>(tick.measuredNs - goNs_) * 1e-9;
    tell(EventKind::TrialEnd, static_cast<double>(facts.result.outcome));
    underWay_ = false;
    step.finished = true;
  }
  return step;
}

RecordedTrial TrialTracker::brokenOff() const {
  RecordedTrial trial = trial_;
  trial.meanForce = meanForce();
  breakOff(trial);
  return trial;
}

}  // namespace reachlab::record
