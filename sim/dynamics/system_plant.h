#pragma once
#include <array>
#include <string>

#include "sim/dynamics/domain_end.h"
#include "sim/dynamics/object/plant_base.h"
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
        domainEnd_(system_, tolerance), states_{State(system_.states()), State(system_.states())} {
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
        status = meetEnd(hand, dt, status, rhs);
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
  StepStatus meetEnd(const HandSegment& hand, double dt, StepStatus status, std::uint64_t& rhs) noexcept {
    const EndMet end = domainEnd_.meet(system_, hand, dt, status, now(), next(), located_, rhs);
    if (end.status == StepStatus::Ok || end.status == StepStatus::AtEnd) restart();
    fraction_ = end.share;
    return end.status;
  }
  bool mayHaveTurned(double dt) noexcept {
    if constexpr (kHas.branches) return system_.turned(now(), next(), dt);
    return false;
  }

  DomainEnd<System> domainEnd_;
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
