#pragma once
#include <cmath>
#include <span>

#include "sim/dynamics/methods/adaptive.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

struct EndMet {
  StepStatus status;
  double share = 1;  // of the tick, with every mass on the constraint; below 1 only for AtEnd
};

/// What happens where masses would leave the domain of the parameters within a tick: they stop at the end, come back from an elastic one, or pass
/// it where the constraint continues. Used by the haptic thread.
template <ObjectSystem System>
class DomainEnd {
 public:
  using State = typename System::State;

  DomainEnd(const System& system, double tolerance) : locator_(system, tolerance) {}

  /// `status` and `next` are what the method's step of `dt` from `now` gave. Ok: `next` is the state after the whole tick. AtEnd: `now` is the
  /// state at the end. Every other status is that of a method which failed, and `now` is as before. `scratch` has room for all masses.
  /// `rhs` counts the right-hand sides.
  EndMet meet(System& system, const HandSegment& hand, double dt, StepStatus status, State& now, State& next, std::span<MassState> scratch,
              std::uint64_t& rhs) noexcept {
    const State before = now;
    [[maybe_unused]] const auto branch = branchOf(system);
    const auto takeBack = [&] {
      now = before;
      if constexpr (kHas.branches) system.takeBack(branch);
    };
    State at = before;
    double begun = 0;
    HandSegment rest = hand;
    // Only the method knows a step over an end that is a cusp. The locator comes up to the cusp.
    const bool seen = status == StepStatus::Ok && !system.inside(next);
    for (bool first = true; rhs < kMaxRhsPerTick; first = false) {
      typename Adaptive<System>::Meeting meeting{false, 1, now};
      if (first && seen) meeting.beyond = next;
      locator_.restart();
      status = locator_.step(system, rest, (1 - begun) * dt, now, at, rhs, &meeting);
      if (status == StepStatus::Ok && !meeting.met) {
        next = at;
        return {status};
      }
      if (!meeting.met && !(first && seen)) {  // not an end: the method itself failed
        takeBack();
        return {status};
      }
      begun += meeting.share * (1 - begun);
      now = at;
      if constexpr (kHas.branches) {
        rest = part(hand, begun, 1);
        if (system.passEnds(meeting.beyond, now, system.handAt(rest, 0), dt)) continue;
        at = now;  // masses that passed, and a place at which the formula has a limit, stay
      }
      system.meetEnd(meeting.beyond, now, system.bounces());
      // Where an end is degenerate (a cusp, a collapsed line) the parameters hold no velocity. The mass stops just before, elastic or not.
      const bool degenerate = !sameSpeed(system, at, now, scratch) || !hasRates(system, rest, now);
      if (degenerate) now = at;
      if (degenerate || !system.bounces()) return {StepStatus::AtEnd, begun};
      rest = part(hand, begun, 1);
    }
    takeBack();
    return {StepStatus::Capped};
  }

 private:
  static constexpr Hooks kHas = System::kHas;

  static auto branchOf(const System& system) noexcept {
    if constexpr (kHas.branches) return system.branch();
    else return 0;
  }

  /// No energy is lost between two states, to rounding.
  static bool sameSpeed(const System& system, const State& a, const State& b, std::span<MassState> scratch) noexcept {
    constexpr double kSame = 1e-9;  // of the squares' sum
    const auto sum = [&](const State& y) {
      system.locate(y, scratch);
      double squares = 0;
      for (const MassState& mass : scratch) squares += dot(mass.v, mass.v);
      return squares;
    };
    const double one = sum(a), other = sum(b);
    return std::abs(one - other) <= kSame * one;
  }

  static bool hasRates(System& system, const HandSegment& hand, const State& y) noexcept {
    constexpr double kFastest = 1e12;  // [1/s] on a cusp, to rounding, the parameter would run at 1e16
    State dy(system.states());
    system.rate(system.handAt(hand, 0), y, dy);
    for (int i = 0; i < system.states(); ++i)
      if (!(std::abs(dy[i]) < kFastest)) return false;
    return true;
  }

  Adaptive<System> locator_;
};

}  // namespace reachlab::dynamics
