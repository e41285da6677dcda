#include "sim/dynamics/exact/oscillator_core.h"

#include <algorithm>
#include <cmath>

#include "sim/dynamics/exact/chain_modes.h"

namespace reachlab::dynamics {

OscillatorCore::OscillatorCore(const ObjectModel& model, bool coupled, double dt) : n_(model.count()), dt_(dt) {
  struct Oscillator {
    ObjectModel model;
    double handStiffness, handDamping, extra, gravity, rest;
  };
  std::vector<Oscillator> oscillators;
  const auto single = [](double stiffness, double damping, double mass, double viscosity = 0) -> ObjectModel {
    return {.mass = {mass}, .handStiffness = {stiffness}, .handDamping = {damping}, .viscosity = viscosity};
  };
  if (model.kind == experiment::ObjectKind::Parallel) {
    for (int i = 0; i < n_; ++i) {
      const double k = coupled ? model.handStiffness[i] : 0, b = coupled ? model.handDamping[i] : 0;
      oscillators.push_back({single(k, b, model.mass[i], model.viscosity), k, b, i == 0 ? 1.0 : 0.0, 1.0, 1.0});
    }
  } else {
    const ChainModes modes = computeModes(model, coupled);
    toModes_ = modes.toModes;
    toMasses_ = modes.toMasses;
    const double k = coupled ? model.handStiffness[0] : 0, b = coupled ? model.handDamping[0] : 0;
    for (int j = 0; j < n_ && n_ >= kFewestEnds; ++j) endShapes_.push_back({toMasses_(0, j), toMasses_(n_ - 1, j)});
    for (int j = 0; j < n_; ++j) {
      const double share = modes.toMasses(0, j);  // force on mass 1 as felt by mode j
      const double rest = modes.toModes.row(j).sum();
      oscillators.push_back({single(modes.squaredFrequency[j], modes.damping[j], 1.0), k * share, b * share, share, rest, rest});
    }
  }
  groups_.resize(lanesFor<kLanes>(n_), Group{});
  bool free = toModes_.size() > 0 && n_ >= kFewestFree;
  for (int j = 0; j < n_; ++j) {
    const Oscillator& o = oscillators[j];
    const Propagator p = computePropagator(o.model, true, dt);
    Group& g = groups_[j / kLanes];
    const int lane = j % kLanes;
    g.xx[lane] = p.d[0];
    g.vx[lane] = p.d[1];
    g.xv[lane] = p.d[2];
    g.vv[lane] = p.d[3];
    g.rest[lane] = o.rest;
    g.extraX[lane] = o.extra * p.force[0][0];
    g.extraV[lane] = o.extra * p.force[0][1];
    g.gravityX[lane] = o.gravity * p.gravity[0];
    g.gravityV[lane] = o.gravity * p.gravity[1];
    for (int k = 0; k < kForceTerms; ++k) {
      g.handX[k][lane] = k > 0 ? o.handStiffness * p.force[k][0] : 0;
      g.handV[k][lane] = k > 0 ? o.handStiffness * p.force[k][1] : 0;
      g.rateX[k][lane] = o.handDamping * p.force[k][0];
      g.rateV[k][lane] = o.handDamping * p.force[k][1];
    }
    damped_ = damped_ || o.handDamping != 0;
    free = free && o.model.handDamping[0] == 0 && std::sqrt(o.model.handStiffness[0]) * dt > kSlowest;
  }
  if (!free) return;
  free_.resize(groups_.size(), FreeGroup{});
  for (int j = 0; j < n_; ++j) {
    const Group& g = groups_[j / kLanes];
    FreeGroup& f = free_[j / kLanes];
    const int lane = j % kLanes;
    f.turn[lane] = g.xx[lane];
    f.vx[lane] = g.vx[lane];
    f.xv[lane] = g.xv[lane];
    f.rest[lane] = g.rest[lane];
    f.period[lane] = 1 / oscillators[j].model.handStiffness[0];
  }
}

OscillatorCore::State OscillatorCore::makeState() const {
  return {std::vector<Lanes>(groups_.size(), Lanes{}), std::vector<Lanes>(groups_.size(), Lanes{})};
}

void OscillatorCore::place(State& state, std::span<const double> x, std::span<const double> v) const noexcept {
  for (int j = 0; j < n_; ++j) {
    double e = 0, rate = 0;
    if (toModes_.size() == 0) {
      e = x[j];
      rate = v[j];
    } else {
      for (int i = 0; i < n_; ++i) {
        e += toModes_(j, i) * x[i];
        rate += toModes_(j, i) * v[i];
      }
    }
    state.x[j / kLanes][j % kLanes] = e;
    state.v[j / kLanes][j % kLanes] = rate;
  }
}

void OscillatorCore::read(const State& state, std::span<double> x, std::span<double> v) const noexcept {
  if (toMasses_.size() == 0) {
    for (int i = 0; i < n_; ++i) {
      x[i] = state.x[i / kLanes][i % kLanes];
      v[i] = state.v[i / kLanes][i % kLanes];
    }
    return;
  }
  double* __restrict place = x.data();
  double* __restrict rate = v.data();
  std::fill_n(place, n_, 0.0);
  std::fill_n(rate, n_, 0.0);
  for (int j = 0; j < n_; ++j) {  // mode by mode: a mode's shape lies in one piece
    const double e = state.x[j / kLanes][j % kLanes], de = state.v[j / kLanes][j % kLanes];
    const double* __restrict shape = toMasses_.data() + static_cast<std::ptrdiff_t>(j) * n_;
    for (int i = 0; i < n_; ++i) {
      place[i] += shape[i] * e;
      rate[i] += shape[i] * de;
    }
  }
}

EndPlaces OscillatorCore::readEnds(const State& state) const noexcept {
  EndPlaces ends;
  for (int j = 0; j < n_; ++j) {
    const double e = state.x[j / kLanes][j % kLanes], de = state.v[j / kLanes][j % kLanes];
    for (std::size_t end = 0; end < 2; ++end) {
      ends.x[end] += endShapes_[j][end] * e;
      ends.v[end] += endShapes_[j][end] * de;
    }
  }
  return ends;
}

// Inlined below: a second call would be a tenth of a single mass's step.
template <int Degree, bool Full>
[[gnu::always_inline]] inline bool OscillatorCore::advance(const State& state, const AxisHand& hand, State& next) const noexcept {
  Lanes check{};
  const Group* group = groups_.data();
  const Lanes *x = state.x.data(), *v = state.v.data();
  Lanes* __restrict nextX = next.x.data(), * __restrict nextV = next.v.data();
  const std::size_t count = state.x.size();  // of groups: cheaper to take from the smaller elements
  // In registers, as the compiler can't know that what is stored is not the hand.
  const Lanes back = broadcast<Lanes>(-hand.origin);
  std::array<Lanes, Degree + 1> moves{};
  for (int k = 1; k <= Degree; ++k) moves[k] = broadcast<Lanes>(hand.r(k));
  for (std::size_t i = 0; i < count; ++i) {
    const Group& g = group[i];
    // What comes from outside does not wait for the state.
    Lanes pushX{}, pushV{};
    if constexpr (Full) {
      pushX = mulAdd(hand.extraForce, g.extraX, g.gravityX * hand.gravity);
      pushV = mulAdd(hand.extraForce, g.extraV, g.gravityV * hand.gravity);
      if (damped_)
        for (int k = 0; k <= Degree; ++k) {
          pushX = mulAdd(hand.v(k), g.rateX[k], pushX);
          pushV = mulAdd(hand.v(k), g.rateV[k], pushV);
        }
    }
    for (int k = 1; k <= Degree; ++k) {
      pushX = mulAdd(moves[k], g.handX[k], pushX);
      pushV = mulAdd(moves[k], g.handV[k], pushV);
    }
    const Lanes e = mulAdd(back, g.rest, x[i]), rate = v[i];
    const Lanes newX = x[i] + mulAdd(g.xx, e, mulAdd(g.xv, rate, pushX));
    const Lanes newV = rate + mulAdd(g.vx, e, mulAdd(g.vv, rate, pushV));
    nextX[i] = newX;
    nextV[i] = newV;
    check = mulAdd(0.0, newX + newV, check);
  }
  return allZero(check);
}

bool OscillatorCore::advance(const State& state, const AxisHand& hand, State& next) const noexcept {
  const bool pushed = hand.extraForce != 0 || hand.gravity != 0;
  const bool smooth = hand.degree <= 3 || (hand.degree <= kFreeDegree && std::abs(hand.r(4)) + std::abs(hand.r(5)) <= kMostFourth);
  if (!free_.empty() && !pushed && smooth) return advanceFree(state, hand, next);
  return withDegree(hand.degree, [&](auto degree) {
    return pushed || damped_ ? advance<degree.value, true>(state, hand, next) : advance<degree.value, false>(state, hand, next);
  });
}

bool OscillatorCore::advanceFree(const State& state, const AxisHand& hand, State& next) const noexcept {
  // Derivatives of h at the step's beginning and their change over it; [m/s^k].
  std::array<double, kFreeDegree + 1> begin{hand.origin}, change{};
  double factor = 1;
  for (int order = 0; order <= kFreeDegree; ++order) {
    if (order > 0) factor *= order / dt_;  // order! / dt^order
    if (order > 0 && order <= hand.degree) begin[order] = factor * hand.r(order);
    double choose = 1;
    for (int k = order + 1; k <= hand.degree; ++k) {
      choose *= static_cast<double>(k) / (k - order);
      change[order] += factor * choose * hand.r(k);
    }
  }
  Lanes check{};
  const FreeGroup* group = free_.data();
  const Lanes *x = state.x.data(), *v = state.v.data();
  Lanes* __restrict nextX = next.x.data(), * __restrict nextV = next.v.data();
  const std::size_t count = free_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const FreeGroup& g = group[i];
    const auto follow = [&](double h, double second, double fourth) {
      return mulAdd(-g.period, mulAdd(-fourth, g.period, broadcast<Lanes>(second)), broadcast<Lanes>(h));
    };
    const Lanes e = mulAdd(-g.rest, follow(begin[0], begin[2], begin[4]), x[i]);
    const Lanes rate = mulAdd(-g.rest, follow(begin[1], begin[3], begin[5]), v[i]);
    const Lanes newX = x[i] + mulAdd(g.rest, follow(change[0], change[2], change[4]), mulAdd(g.turn, e, g.xv * rate));
    const Lanes newV = v[i] + mulAdd(g.rest, follow(change[1], change[3], change[5]), mulAdd(g.turn, rate, g.vx * e));
    nextX[i] = newX;
    nextV[i] = newV;
    check += newX + newV;
  }
  double sum = 0;
  for (int lane = 0; lane < kLanes; ++lane) sum += check[lane];
  return std::isfinite(sum);
}

}  // namespace reachlab::dynamics
