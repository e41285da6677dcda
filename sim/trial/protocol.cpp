#include "sim/trial/protocol.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/math/segment.h"
#include "base/ticks.h"

namespace reachlab::trial {
namespace {

struct Worst {
  int mass = 0;  // from 1
  double by = 0;
};

// The mass farthest beyond dx (or dv); mass 0 when all are within.
template <typename Measure>
Worst findWorst(std::span<const dynamics::MassState> masses, double tolerance, Measure&& measure) noexcept {
  Worst worst;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const double excess = measure(masses[i]) - tolerance;
    if (!(excess <= 0) && !(worst.mass > 0 && excess <= worst.by)) worst = {static_cast<int>(i) + 1, excess};
  }
  return worst;
}

bool hasArrived(const ProtocolSettings& s, const dynamics::MassState& mass) noexcept {
  return norm(mass.r - s.target) - s.positionTolerance <= 0 && norm(mass.v) - s.velocityTolerance <= 0;
}

// No mass is away, known from the first mass that is. The last one is the last to come.
bool haveAllArrived(const ProtocolSettings& s, std::span<const dynamics::MassState> masses) noexcept {
  return std::all_of(masses.rbegin(), masses.rend(), [&](const dynamics::MassState& mass) { return hasArrived(s, mass); });
}

void end(ProtocolState& state, std::uint64_t tick, Outcome outcome, Reason reason, Worst worst = {}) noexcept {
  const bool moved = state.phase == Phase::Moving;
  state.phase = Phase::Done;
  const double time = moved ? static_cast<double>(tick - state.onsetTick) * kTickSeconds : 0;
  state.result = {outcome, reason, worst.mass, worst.by, time, moved ? state.onsetTick : 0, tick};
}

void putUp(const ProtocolInput& in, ProtocolState& state) noexcept {
  state = {.phase = Phase::Waiting, .trial = state.trial + 1, .planned = in.planned, .putUpTick = in.tick};
}

bool restsAtStart(const ProtocolSettings& s, const ProtocolInput& in) noexcept {
  const auto atStart = [&](const Vec3& hip) { return norm(hip - s.start) <= s.armRadius; };
  return in.handValid && in.hipSpeed <= s.restSpeed && std::all_of(in.hips.begin(), in.hips.end(), atStart);
}

// Movement begins with the hand that moves first.
bool hasLeft(const ProtocolSettings& s, const ProtocolInput& in, const ProtocolState& state) noexcept {
  if (!in.handValid) return false;
  for (std::size_t i = 0; i < in.hips.size(); ++i)
    if (norm(in.hips[i] - state.armedAt[i]) > s.onset) return true;
  return false;
}

void arm(const ProtocolInput& in, ProtocolState& state) noexcept {
  state.phase = Phase::Armed;
  state.armedTick = in.tick;
  std::copy(in.hips.begin(), in.hips.end(), state.armedAt.begin());
  state.gone = !state.planned.catchTrial && state.planned.foreperiodTicks <= 0;
}

// Counts what this tick's gap took of the movement, and ends a trial that missed too much of it; true when it did.
bool endByMissedTime(const ProtocolSettings& s, const ProtocolInput& in, ProtocolState& state) noexcept {
  state.missedTicks += in.missedTicks;
  if (in.missedTicks == 0 || (state.missedTicks <= s.maxMissedTicks && std::int64_t{in.missedTicks} + 1 <= s.maxGapTicks)) return false;
  return end(state, in.tick, Outcome::Interrupted, Reason::Timing), true;
}

void beginWay(const ProtocolInput& in, ProtocolState& state) noexcept {
  state.viaPassed = 0;
  state.viaLeast = std::numeric_limits<double>::infinity();
  if (!in.masses.empty()) state.viaFrom = in.masses.back().r;
}

bool hasPassedAll(const ProtocolSettings& s, const ProtocolInput& in, ProtocolState& state) noexcept {
  const auto count = static_cast<std::int32_t>(s.via.size());
  if (state.viaPassed == count || in.masses.empty()) return state.viaPassed == count;
  const Vec3 from = std::exchange(state.viaFrom, in.masses.back().r);
  while (state.viaPassed < count) {
    state.viaLeast = std::min(state.viaLeast, distanceToSegment(s.via[static_cast<std::size_t>(state.viaPassed)], from, state.viaFrom));
    if (!(state.viaLeast <= s.viaRadius)) return false;
    ++state.viaPassed;
    state.viaLeast = std::numeric_limits<double>::infinity();
  }
  return true;
}

// At onset every mass is at the target of a way that comes back.
bool hasBeenAway(const ProtocolSettings& s, const ProtocolInput& in, ProtocolState& state) noexcept {
  if (!s.comesBack || in.masses.empty()) return true;
  state.farthest = std::max(state.farthest, norm(in.masses.back().r - s.target));
  return state.farthest > s.positionTolerance;
}

void watchForOnset(const ProtocolSettings& s, const ProtocolInput& in, ProtocolState& state) noexcept {
  const auto waited = static_cast<std::int64_t>(in.tick - state.armedTick);
  const std::int64_t foreperiod = std::max(0, state.planned.foreperiodTicks);
  if (hasLeft(s, in, state)) {
    state.onsetTick = in.tick;
    state.phase = Phase::Moving;
    beginWay(in, state);
    if (!endByMissedTime(s, in, state) && !state.gone) end(state, in.tick, Outcome::Failure, Reason::Early);
    return;
  }
  if (state.planned.catchTrial) {
    if (waited >= foreperiod + s.latestTick) end(state, in.tick, Outcome::Success, Reason::None);
    return;
  }
  if (waited >= foreperiod + s.timeoutTicks) return end(state, in.tick, Outcome::Aborted, Reason::NoOnset);
  state.gone = waited >= foreperiod;
}

void watchForArrival(const ProtocolSettings& s, const ProtocolInput& in, ProtocolState& state) noexcept {
  const auto moved = static_cast<std::int64_t>(in.tick - state.onsetTick);
  if (moved >= s.earliestTick) state.semaphore = Semaphore::Green;
  const bool passed = hasPassedAll(s, in, state);
  const bool beenAway = hasBeenAway(s, in, state);
  if (passed && beenAway && haveAllArrived(s, in.masses)) {
    if (moved < s.earliestTick)
      end(state, in.tick, Outcome::Failure, Reason::TimeShort, {0, s.earliest - static_cast<double>(moved) * kTickSeconds});
    else end(state, in.tick, Outcome::Success, Reason::None);
    return;
  }
  if (moved < s.latestTick) return;
  const Worst position = findWorst(in.masses, s.positionTolerance, [&](const dynamics::MassState& m) { return norm(m.r - s.target); });
  const bool away = position.mass > 0;
  Worst worst = away ? position : findWorst(in.masses, s.velocityTolerance, [](const dynamics::MassState& m) { return norm(m.v); });
  if (s.judgesHand) worst.mass = 0;
  if (!passed) end(state, in.tick, Outcome::Failure, Reason::Via, {0, state.viaLeast - s.viaRadius});
  else if (!beenAway) end(state, in.tick, Outcome::Failure, Reason::Position, {0, s.positionTolerance - state.farthest});
  else end(state, in.tick, Outcome::Failure, away ? Reason::Position : Reason::Velocity, worst);
  state.semaphore = Semaphore::Red;
}

// What ends a trial whatever the subject does; true when it did.
bool endByForce(const ProtocolSettings& s, const ProtocolInput& in, ProtocolState& state) noexcept {
  if (in.command == Command::Interrupt) return end(state, in.tick, Outcome::Interrupted, Reason::Experimenter), true;
  if (in.command == Command::Abort) return end(state, in.tick, Outcome::Aborted, Reason::Experimenter), true;
  state.lostTicks = in.handValid ? 0 : state.lostTicks + 1;
  if (in.handBroken || state.lostTicks > kLostTicks) return end(state, in.tick, Outcome::Interrupted, Reason::DeviceLost), true;
  if (state.phase == Phase::Moving && endByMissedTime(s, in, state)) return true;
  if (!isEngaged(state.phase)) return false;
  switch (in.status) {
    case dynamics::StepStatus::Ok:
    case dynamics::StepStatus::HandLost: break;
    case dynamics::StepStatus::AtEnd: return end(state, in.tick, Outcome::Failure, Reason::EndOfConstraint), true;
    case dynamics::StepStatus::PeerLost: return end(state, in.tick, Outcome::Interrupted, Reason::PeerLost), true;
    case dynamics::StepStatus::NotFinite:
    case dynamics::StepStatus::Capped:
    case dynamics::StepStatus::NoContinuation: return end(state, in.tick, Outcome::Aborted, Reason::Computation), true;
  }
  if (in.clamped && s.forceLimitEndsTrial) return end(state, in.tick, Outcome::Failure, Reason::ForceLimit), true;
  return false;
}

}  // namespace

void advance(const ProtocolSettings& settings, const ProtocolInput& input, ProtocolState& state) noexcept {
  if (state.phase == Phase::Idle || state.phase == Phase::Done) {
    if (input.command == Command::NextTrial) putUp(input, state);
    return;
  }
  if (endByForce(settings, input, state)) return;
  switch (state.phase) {
    case Phase::Waiting:
      if (restsAtStart(settings, input)) ++state.restTicks;
      else state.restTicks = 0;
      if (state.restTicks > settings.restTicks) arm(input, state);
      else if (static_cast<std::int64_t>(input.tick - state.putUpTick) >= settings.startTimeoutTicks)
        end(state, input.tick, Outcome::Aborted, Reason::NoStart);
      break;
    case Phase::Armed: watchForOnset(settings, input, state); break;
    case Phase::Moving: watchForArrival(settings, input, state); break;
    case Phase::Idle:
    case Phase::Done: break;
  }
}

bool needsEveryMass(const ProtocolSettings& settings, const ProtocolState& state, std::uint64_t tick,
                    std::span<const dynamics::MassState> masses) noexcept {
  if (state.phase != Phase::Moving || masses.empty()) return false;
  if (static_cast<std::int64_t>(tick - state.onsetTick) >= settings.latestTick) return true;
  return hasArrived(settings, masses.back()) && hasArrived(settings, masses.front());
}

}  // namespace reachlab::trial
