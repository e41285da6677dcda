#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "sim/dynamics/exact/linear_space.h"
#include "sim/dynamics/hand/axis_hand.h"
#include "sim/dynamics/object/end_masses.h"
#include "sim/dynamics/object/plant_base.h"

namespace reachlab::dynamics {

/// Linear scenes, stepped exactly by `Core` (DenseCore or OscillatorCore). At each tick the state is that of the differential equation to
/// rounding, for any stiffness, damping and polynomial hand.
template <class Core, int Axes>
class LinearPlant final : public PlantBase, public EndMasses {
 public:
  LinearPlant(const ObjectModel& model, const LinearSpace& space, double dt)
      : PlantBase(model), space_(space), length_(norm(space.tangent)), axis_(Axes == 1 ? space.tangent / length_ : Vec3{}) {
    bounded_ = Axes == 1 && (std::isfinite(space.domain.lo) || std::isfinite(space.domain.hi)) && !space.domain.periodic;
    alongX_ = Axes == 1 && axis_.x == 1;
    for (int a = 0; a < Axes; ++a) origin_[a] = along(space.origin, a), gravity_[a] = along(model.gravity, a);
    x_.resize(model.count());
    v_.resize(model.count());
    cores_.push_back(makeCores(dt));
    current_ = cores_[0].get();
    for (int a = 0; a < Axes; ++a) states_[0].push_back(core().makeState()), states_[1].push_back(core().makeState());
  }

  void place(std::span<const double> q, std::span<const double> qRate) noexcept override {
    for (int a = 0; a < Axes; ++a) {
      std::fill(x_.begin(), x_.end(), Axes == 1 ? q[0] * length_ : q[a]);
      std::fill(v_.begin(), v_.end(), Axes == 1 ? qRate[0] * length_ : qRate[a]);
      core().place(state()[a], x_, v_);
    }
    fraction_ = 1;
    fresh_ = freshEnds_ = false;
  }
  void setExtraForce(const Vec3& force) noexcept override {
    extra_ = force;
    for (int a = 0; a < Axes; ++a) extraAlong_[a] = along(force, a);
  }
  void setCoupled(bool coupled) noexcept override {
    if (coupled == coupled_) return;
    for (int a = 0; a < Axes; ++a) {
      core().read(state()[a], x_, v_);
      (coupled ? current_->coupled : current_->alone).place(state()[a], x_, v_);
    }
    coupled_ = coupled;
    fresh_ = freshEnds_ = false;
  }

  StepStatus step(const HandSegment& hand, double dt) noexcept override {
    if (dt != current_->dt) selectStep(dt);
    fraction_ = 1;
    fresh_ = freshEnds_ = false;
    const Core& core = this->core();
    for (int a = 0; a < Axes; ++a) {
      AxisHand axisHand;
      if (coupled_) {
        axisHand.degree = hand.degree;
        if (Axes == 3 || alongX_) {  // the usual line needs no products
          axisHand.position = component(hand.position, a);
          axisHand.velocity = component(hand.velocity, a);
        } else {
          axisHand.position = project(hand.position, hand.degree, projected_[0].data());
          axisHand.velocity = project(hand.velocity, hand.degree, projected_[1].data());
        }
        axisHand.origin = axisHand.r(0) - origin_[a];
      }
      axisHand.extraForce = extraAlong_[a];
      axisHand.gravity = gravity_[a];
      if (!core.advance(state()[a], axisHand, next()[a])) return StepStatus::NotFinite;
    }
    if constexpr (Axes == 1)
      if (bounded_ && leaves()) return StepStatus::AtEnd;
    now_ = 1 - now_;  // a read of swapped vectors is wider than the write, and waits for it
    return StepStatus::Ok;
  }
  bool needsHandVelocity() const noexcept override {
    return std::any_of(model_.handDamping.begin(), model_.handDamping.end(), [](double damping) { return damping != 0; });
  }
  void restart() noexcept override {}

  void observe(const HandSample& hand, std::span<MassState> masses) const noexcept override {
    locate(masses.first(model_.count()));
    for (int i = 0; i < model_.count(); ++i) {
      const Vec3 a = netForce(model_, {hand, coupled_, extra_}, masses, i) / model_.mass[i];
      masses[i].a = Axes == 1 ? dot(a, axis_) * axis_ : a;
    }
  }
  bool observeEnds(std::span<MassState> masses) const noexcept override {
    if (!readsEnds()) return false;
    MassState *first = &masses[0], *last = &masses[static_cast<std::size_t>(model_.count()) - 1];
    for (int a = 0; a < Axes; ++a) {
      const EndPlaces& ends = endsAlong(a);
      put(a, ends.x[0], ends.v[0], *first);
      put(a, ends.x[1], ends.v[1], *last);
    }
    return true;
  }
  Vec3 couplingForce(const HandSample& hand) const noexcept override {
    if (model_.kind == experiment::ObjectKind::Parallel || !readsEnds()) return PlantBase::couplingForce(hand);
    MassState first;
    for (int a = 0; a < Axes; ++a) put(a, endsAlong(a).x[0], endsAlong(a).v[0], first);
    Vec3 force;
    force += handForce(model_, {hand, coupled_, extra_}, first, 0);  // as the sum over many masses, for the sign of -0
    return force;
  }
  std::string stopReason() const override { return fraction_ < 1 ? "a mass reached the end of the line's domain" : std::string(); }

 private:
  struct Cores {
    double dt;
    Core coupled, alone;
  };
  [[gnu::noinline]] std::unique_ptr<Cores> makeCores(double dt) const {
    return std::make_unique<Cores>(Cores{dt, Core(model_, true, dt), Core(model_, false, dt)});
  }
  std::vector<typename Core::State>& state() noexcept { return states_[now_]; }
  const std::vector<typename Core::State>& state() const noexcept { return states_[now_]; }
  std::vector<typename Core::State>& next() noexcept { return states_[1 - now_]; }
  const Core& core() const noexcept { return coupled_ ? current_->coupled : current_->alone; }
  double along(const Vec3& vector, int a) const noexcept {
    if constexpr (Axes == 1) return dot(vector, axis_);
    return a == 0 ? vector.x : a == 1 ? vector.y : vector.z;
  }
  using Coefficients = HandSegment::Coefficients;
  static const double* component(const Coefficients& c, int a) noexcept { return a == 0 ? &c[0].x : a == 1 ? &c[0].y : &c[0].z; }
  // This function and selectStep are calls, so that the usual step needs neither their registers nor their stack.
  [[gnu::noinline]] const double* project(const Coefficients& c, int degree, double* out) const noexcept {
    for (int k = 0; k <= (degree | 1); ++k) out[k * AxisHand::kStride] = dot(c[k], axis_);
    return out;
  }
  /// A step other than the compiled one, for the last row of a simulation. It is computed once and kept. Allocates, so a haptic loop never
  /// does it.
  [[gnu::noinline]] void selectStep(double dt) noexcept {
    for (const auto& cores : cores_)
      if (cores->dt == dt) {
        current_ = cores.get();
        return;
      }
    if (cores_.size() > 4) cores_.resize(1);
    cores_.push_back(makeCores(dt));
    current_ = cores_.back().get();
  }

  void put(int a, double x, double v, MassState& mass) const noexcept {
    if constexpr (Axes == 1) {
      const bool unit = length_ == 1;  // the usual line needs no quotients
      mass.q = {unit ? x : x / length_, 0};
      mass.qRate = {unit ? v : v / length_, 0};
      mass.r = space_.origin + x * axis_;
      mass.v = v * axis_;
    } else {
      (a == 0 ? mass.r.x : a == 1 ? mass.r.y : mass.r.z) = x;
      (a == 0 ? mass.v.x : a == 1 ? mass.v.y : mass.v.z) = v;
    }
  }
  /// Reading two masses costs less than reading all.
  bool readsEnds() const noexcept {
    if constexpr (requires { core().hasEnds(); }) return !fresh_ && core().hasEnds();
    return false;
  }
  /// Positions and velocities of masses 1 and N now, read once per step. Only where readsEnds().
  const EndPlaces& endsAlong(int a) const noexcept {
    if constexpr (requires { core().readEnds(state()[0]); })
      for (int b = 0; b < Axes && !freshEnds_; ++b) ends_[b] = core().readEnds(state()[b]);
    freshEnds_ = true;
    return ends_[a];
  }
  void locate(std::span<MassState> masses) const noexcept override {
    for (int a = 0; a < Axes; ++a) {
      if (!fresh_) core().read(state()[a], x_, v_);
      fresh_ = Axes == 1;
      for (std::size_t i = 0; i < masses.size(); ++i) put(a, x_[i], v_[i], masses[i]);
    }
  }

  /// True if a mass is beyond an end after the step. The state then becomes that at which the first mass meets the end. It follows a cubic
  /// through both ends of the step with error dt^4 x''''/384.
  bool leaves() noexcept {
    const int n = model_.count();
    std::vector<double>&x1 = x_, &v1 = v_;
    core().read(next()[0], x1, v1);
    const double lo = space_.domain.lo * length_, hi = space_.domain.hi * length_;
    bool outside = false;
    for (int i = 0; i < n; ++i) outside = outside || x1[i] < lo || x1[i] > hi;
    if (!outside) return false;
    std::array<double, experiment::kMaxMasses> x0, v0;
    core().read(state()[0], {x0.data(), static_cast<std::size_t>(n)}, {v0.data(), static_cast<std::size_t>(n)});
    const double dt = current_->dt;
    const auto cubic = [&](int i, double s) {
      const double d = x1[i] - x0[i], c2 = 3 * d - dt * (2 * v0[i] + v1[i]), c3 = -2 * d + dt * (v0[i] + v1[i]);
      return std::array{x0[i] + s * (dt * v0[i] + s * (c2 + s * c3)), v0[i] + s * (2 * c2 + 3 * s * c3) / dt};
    };
    double first = 1;
    for (int i = 0; i < n; ++i) {
      if (x1[i] >= lo && x1[i] <= hi) continue;
      double inside = 0, beyond = first;
      for (int round = 0; round < 60; ++round) {
        const double middle = 0.5 * (inside + beyond), x = cubic(i, middle)[0];
        (x < lo || x > hi ? beyond : inside) = middle;
      }
      first = std::min(first, inside);
    }
    std::array<double, experiment::kMaxMasses> x, v;
    for (int i = 0; i < n; ++i) {
      const auto [place, speed] = cubic(i, first);
      x[i] = std::fmin(std::fmax(place, lo), hi);
      v[i] = speed;
    }
    core().place(state()[0], {x.data(), static_cast<std::size_t>(n)}, {v.data(), static_cast<std::size_t>(n)});
    fraction_ = first;
    return true;
  }

  LinearSpace space_;
  double length_;  // [m] |r_phi|
  Vec3 axis_;
  bool bounded_ = false, alongX_ = false;
  std::array<double, Axes> origin_{}, gravity_{}, extraAlong_{};                    // [m], [m/s^2], [N] along the axes
  std::array<std::array<double, AxisHand::kStride * kForceTerms>, 2> projected_{};  // scratch: the hand along a slanted line
  std::vector<std::unique_ptr<Cores>> cores_;
  Cores* current_ = nullptr;
  std::array<std::vector<typename Core::State>, 2> states_;  // now and after the step, by turns, one for each axis
  int now_ = 0;
  mutable std::vector<double> x_, v_;  // scratch
  mutable bool fresh_ = false;         // one axis: positions of the masses now, read once per step (N^2 from modes)
  mutable std::array<EndPlaces, Axes> ends_{};
  mutable bool freshEnds_ = false;  // `ends_` belongs to the current state
};

}  // namespace reachlab::dynamics
