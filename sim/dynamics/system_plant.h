#pragma once
#include <array>
#include <string>

#include "sim/dynamics/methods/adaptive.h"
#include "sim/dynamics/object/plant_base.h"
#include "sim/dynamics/systems/surface_rates.h"
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {

/// A System as a plant: all but the method of its steps, which SteppedPlant adds.
template <ObjectSystem TheSystem>
class SystemPlant : public PlantBase {
 public:
  using System = TheSystem;
  using State = typename System::State;

  SystemPlant(const ObjectModel& model, System system, double tolerance)
      : PlantBase(model), system_(std::move(system)),
        locator_(system_, tolerance), states_{State(system_.states()), State(system_.states())} {
    for (int i = 0; i < system_.states(); ++i) now()[i] = 0;
  }

  void place(std::span<const double> q, std::span<const double> qRate) noexcept override {
    system_.place(q, qRate, now());
    restart();
    stopped_ = StepStatus::Ok;
    fraction_ = 1;
  }
  void setExtraForce(const Vec3& force) noexcept override {
    extra_ = force;
    system_.setExtraForce(force);
    restart();
  }
  void setCoupled(bool coupled) noexcept override {
    if (coupled == coupled_) return;
    coupled_ = coupled;
    system_.setCoupled(model_, coupled);
    restart();
  }

  void observe(const HandSample& hand, std::span<MassState> masses) const noexcept override {
    const auto used = masses.first(static_cast<std::size_t>(model_.count()));
    system_.locate(now(), used);
    if constexpr (kHas.parametrising) system_.parametrise(used);
    State dy(system_.states());
    system_.rate(system_.handOf(hand), now(), dy);
    system_.accelerate(now(), dy, used);
  }
  std::string stopReason() const override { return system_.stopReason(stopped_, now()); }

 protected:
  static constexpr Hooks kHas = System::kHas;

  State& now() noexcept { return states_[current_]; }
  const State& now() const noexcept { return states_[current_]; }
  State& next() noexcept { return states_[1 - current_]; }
  void locate(std::span<MassState> masses) const noexcept override { system_.locate(now(), masses); }

  /// Before the method's step. False where the motion has no continuation.
  [[gnu::always_inline]] bool begin(const HandSegment& hand) noexcept {
    fraction_ = 1;
    if constexpr (kHas.holding)
      if (system_.anyHeld() && !system_.release(system_.handAt(hand, 0), system_.handAt(hand, 1), now())) {
        fraction_ = 0;
        stopped_ = StepStatus::NoContinuation;
        return false;
      }
    return true;
  }
  /// After the method's step from now() to next(), which ended with `status`. `rhs`: the right-hand sides that it took.
  [[gnu::always_inline]] StepStatus finish(const HandSegment& hand, double dt, StepStatus status, std::uint64_t rhs) noexcept {
    if constexpr (kHas.ends)
      if (system_.bounded() && (status != StepStatus::Ok || !system_.inside(next()) || mayHaveTurned(dt)))
        status = meetEnds(hand, dt, status, rhs);
    if constexpr (kHas.settling)
      if (status == StepStatus::Ok) {
        const Settled settled = system_.settle(now(), next());
        if (settled != Settled::Same) restart();
        if (settled == Settled::Lost) status = StepStatus::NoContinuation;
      }
    if constexpr (kHas.losing)
      if ((status == StepStatus::Capped || status == StepStatus::NotFinite) && system_.lost(now())) status = StepStatus::NoContinuation;
    if (status == StepStatus::Ok) current_ = 1 - current_;
    if (status == StepStatus::NoContinuation) fraction_ = 0;
    stopped_ = status;
    rhs_ += rhs;
    return status;
  }

  System system_;

 private:
  bool mayHaveTurned(double dt) noexcept {
    if constexpr (kHas.branches) return system_.turned(now(), next(), dt);
    return false;
  }

  /// The part of the tick with every mass still on the constraint, and the state at its end. At an elastic end the rest of the tick
  /// follows.
  StepStatus meetEnds(const HandSegment& hand, double dt, StepStatus status, std::uint64_t& rhs) noexcept {
    const State before = now();
    [[maybe_unused]] const auto branch = branchNow();
    const auto takeBack = [&] {
      now() = before;
      if constexpr (kHas.branches) system_.takeBack(branch);
    };
    State at = before;
    double begun = 0;
    HandSegment rest = hand;
    // Only the method knows a step over an end that is a cusp. The locator comes up to the cusp.
    const bool seen = status == StepStatus::Ok && !system_.inside(next());
    for (bool first = true; rhs < kMaxRhsPerTick; first = false) {
      typename Adaptive<System>::Meeting meeting{false, 1, now()};
      if (first && seen) meeting.beyond = next();
      locator_.restart();
      status = locator_.step(system_, rest, (1 - begun) * dt, now(), at, rhs, &meeting);
      if (status == StepStatus::Ok && !meeting.met) {
        next() = at;
        restart();
        return StepStatus::Ok;
      }
      if (!meeting.met && !(first && seen)) {  // not an end: the method itself failed
        takeBack();
        return status;
      }
      begun += meeting.share * (1 - begun);
      now() = at;
      if constexpr (kHas.branches) {
        rest = part(hand, begun, 1);
        if (system_.passEnds(meeting.beyond, now(), system_.handAt(rest, 0), dt)) continue;
        at = now();  // masses that passed, and a place at which the formula has a limit, stay
      }
      system_.meetEnd(meeting.beyond, now(), system_.bounces());
      // Where an end is degenerate (a cusp, a collapsed line) the parameters hold no velocity. The mass stops just before, elastic or not.
      const bool degenerate = !sameSpeed(at, now()) || !hasRates(rest, now());
      if (degenerate) now() = at;
      if (degenerate || !system_.bounces()) {
        fraction_ = begun;
        restart();
        return StepStatus::AtEnd;
      }
      rest = part(hand, begun, 1);
    }
    takeBack();
    return StepStatus::Capped;
  }

  auto branchNow() const noexcept {
    if constexpr (kHas.branches) return system_.branch();
    else return 0;
  }

  /// No energy is lost between two states, to rounding.
  bool sameSpeed(const State& a, const State& b) const noexcept {
    constexpr double kSame = 1e-9;  // of the squares' sum
    const auto sum = [&](const State& y) {
      system_.locate(y, located_);
      double squares = 0;
      for (const MassState& mass : located_) squares += dot(mass.v, mass.v);
      return squares;
    };
    const double one = sum(a), other = sum(b);
    return std::abs(one - other) <= kSame * one;
  }

  bool hasRates(const HandSegment& hand, const State& y) const noexcept {
    constexpr double kFastest = 1e12;  // [1/s] on a cusp, to rounding, the parameter would run at 1e16
    State dy(system_.states());
    system_.rate(system_.handAt(hand, 0), y, dy);
    for (int i = 0; i < system_.states(); ++i)
      if (!(std::abs(dy[i]) < kFastest)) return false;
    return true;
  }

  Adaptive<System> locator_;
  std::array<State, 2> states_;  // now and after the step, by turns, without copies
  int current_ = 0;
  StepStatus stopped_ = StepStatus::Ok;
};

/// `Base` (a SystemPlant) stepped by `Method`: the plant of every scene without an exact propagator, or with another requested method.
template <class Base, template <class> class Method>
class SteppedPlant final : public Base {
 public:
  SteppedPlant(const ObjectModel& model, const typename Base::System& system, double tolerance)
      : Base(model, system, tolerance), method_(this->system_, tolerance) {}

  StepStatus step(const HandSegment& hand, double dt) noexcept override {
    if (!this->begin(hand)) return StepStatus::NoContinuation;
    std::uint64_t rhs = 0;
    const StepStatus status = method_.step(this->system_, hand, dt, this->now(), this->next(), rhs);
    return this->finish(hand, dt, status, rhs);
  }
  void restart() noexcept override { method_.restart(); }

 private:
  Method<typename Base::System> method_;
};

}  // namespace reachlab::dynamics
