#pragma once
#include <limits>

#include "sim/dynamics/methods/adaptive.h"
#include "constraints/constraint.h"

namespace reachlab::dynamics {

/// Ticks near and through cusps, for curves in their tangential form. Where |r_phi| is small the independent variable becomes a fictitious
/// time tau with dt = |r_phi|/c dtau (Sundman's transformation). |r_phi| is that of the mass nearest its cusp. Then
///   phi' = v/c,   v' = |r_phi|/c dv/dt,   t' = |r_phi|/c
/// and no term is divided by |r_phi|. At a true cusp |r_phi| = 0. It is found where r_phi.r_phiphi changes sign, and a sub-step ends
/// exactly there. Arc length and speed continue and only the tangent turns. So the bead passes with its energy and the methods see smooth
/// pieces.
template <Equations System>
class CuspAdaptive {
 public:
  using State = typename System::State;
  CuspAdaptive(const System& system, double tolerance)
      : regular_(system, tolerance), tolerance_(tolerance > 0 ? tolerance : kDefaultTolerance) {}
  void restart() noexcept {
    regular_.restart();
    last_ = 0;
  }

  StepStatus step(const System& system, const HandSegment& hand, double dt, const State& y, State& next, std::uint64_t& rhs) noexcept {
    bool timeAlone = false;  // where |r_phi| is large: phi is smooth in time there
    bool narrow = false;     // many sub-steps are regular there
    if constexpr (System::kHas.pieces) {
      timeAlone = system.isSteep(y);
      narrow = system.meetsNarrow(y, dt);
    }
    if (timeAlone || nearest(system, y).speed > kFar * system.speedScale) {
      std::uint64_t tried = 0;
      const StepStatus status = regular_.step(system, hand, dt, y, next, tried);
      rhs += tried;
      if (timeAlone || narrow || (status == StepStatus::Ok && tried < kSuspicious)) return status;
    }
    return pass(system, hand, dt, y, next, rhs);
  }

 private:
  static constexpr double kFar = 0.25;                // of the largest |r_phi|: mostly no hard place within a tick
  static constexpr std::uint64_t kSuspicious = 100;   // right-hand sides of a tick that was not regular after all
  static constexpr int kMaxRhs = 3 * kMaxRhsPerTick;  // of a tick that passes cusps: five masses that pass one in a tick take 1,900
  static constexpr double kCusp = 1e-9;               // |r_phi| over c below which a minimum is a true cusp
  static constexpr double kOnCusp = 1e-13;            // |r_phi| over c of a mass that is on it
  static constexpr double kAtRest = 1e-14;            // [m/s] below it the side to which a mass leaves a cusp is undetermined
  static constexpr double kTogether = 1e-13;          // of 1 + |phi|: the distance of masses at one place
  static constexpr double kLongest = 0.3;             // in phi: a longer sub-step could go over a minimum of |r_phi|
  static constexpr double kGrowth = 5;                // largest ratio of a sub-step to the one before it; 1 right after a rejection
  static constexpr double kLeast = 1e-300;            // instead of a divisor that is zero
  static constexpr int kSize = System::kStates > 0 ? System::kStates + 1 : 0;
  using Extended = Numbers<kSize>;  // y and t

  struct Lead {
    int mass = 0;
    double speed = 0;  // [m] |r_phi|
  };
  static Lead nearest(const System& system, const State& y) noexcept {
    Lead lead{0, system.speedAt(0, y[0])};
    for (int i = 1; i < system.n(); ++i)
      if (const double speed = system.speedAt(i, y[i]); speed < lead.speed) lead = {i, speed};
    return lead;
  }

  /// One tick in fictitious time, sub-step by sub-step. `y` is the state reached, `trial` the state to which the next sub-step leads.
  struct Passage {
    const System& system;
    const HandSegment& hand;
    double dt;         // [s]
    double tolerance;  // of each number's scale
    int n = system.states();
    double c = system.speedScale;  // [m]
    Extended y{n + 1}, trial{n + 1};
    dop853::Stages<kSize> k = dop853::makeStages<kSize>(n + 1);
    Lead lead{};
    State plain{n}, rates{n};  // room for the state without t, and for its slope
    int rhs = 0;
    bool onCusp = false;  // the last sub-step ended there

    void rate(const Extended& at, Extended& d) noexcept {
      for (int i = 0; i < n; ++i) plain[i] = at[i];
      const auto now = system.handAt(hand, at[n] / dt);
      double speed = 0;
      if constexpr (System::kHas.leadRate) {
        system.rate(now, plain, rates, lead.mass, speed);
      } else {
        system.rate(now, plain, rates);
        speed = system.speedAt(lead.mass, at[lead.mass]);
      }
      const double factor = speed / c;
      for (int i = 0; i < n; ++i) d[i] = factor * rates[i];
      // Masses at one place have one |r_phi|. On the cusp their ratio is 0/0.
      for (int i = 0; i < system.n(); ++i)
        if (std::abs(at[i] - at[lead.mass]) <= kTogether * (1 + std::abs(at[i])) && &system.curveOf(i) == &system.curveOf(lead.mass))
          d[i] = at[system.rates() + i] / c;
      d[n] = factor;
    }
    /// A sub-step of tau from y to `trial`. Returns its estimated error, where 1 is the most allowed.
    double attempt(double tau) noexcept {
      rhs += dop853::kStages - 1;
      return dop853::attempt<kSize>(
          [&](double, const Extended& at, Extended& d) { rate(at, d); },
          [&](int i, double value) { return i < n ? tolerance * (system.scale(i) + std::abs(value)) : tolerance; }, 0, tau, y, k, trial);
    }

    /// Selects the mass that is nearest its cusp now. False where it rests on the cusp.
    bool chooseLead() noexcept {
      for (int i = 0; i < n; ++i) plain[i] = y[i];
      lead = nearest(system, plain);
      if (lead.speed <= kOnCusp * c && std::abs(y[system.rates() + lead.mass]) <= kAtRest) return false;
      rate(y, k[0]);
      ++rhs;
      return true;
    }
    /// The longest sub-step that crosses neither a minimum of |r_phi| nor the end of the tick.
    double limit(double h) const noexcept {
      const double speed = std::abs(y[system.rates() + lead.mass]);
      h = std::min(h, kLongest * c / std::max(speed, kLeast));
      if constexpr (System::kHas.sight) {
        State at(n), slope(n);
        for (int i = 0; i < n; ++i) at[i] = y[i], slope[i] = k[0][i];
        h = system.reach(at, slope, h);
      }
      return std::min(h, aim(system, lead.mass, y[lead.mass], k[0][lead.mass], k[0][system.rates() + lead.mass] / c, dt - y[n]));
    }

    double slope(double phi) const noexcept {
      const constraints::CurvePoint p = evaluate(system.curveOf(lead.mass), phi);
      return dot(p.rPhi, p.rPhiPhi);
    }
    /// |r_phi| falls at the start of the sub-step and rises at its end.
    bool crossesMinimum(double error) const noexcept {
      const double from = y[lead.mass], to = trial[lead.mass];
      if (!std::isfinite(error) || from == to || onCusp) return false;
      const double direction = to > from ? 1 : -1;
      return direction * slope(from) < 0 && direction * slope(to) > 0;
    }
    /// Shortens the sub-step of h so that it ends on the true cusp that it crosses, by Newton's method in tau. False if there is no cusp,
    /// or if the method does not reach it. `error` becomes that of the shortened sub-step.
    bool endOnCusp(double& h, double& error) noexcept {
      constexpr int kRounds = 12;
      constexpr double kMet = 4e-16, kNear = 1e-12;  // of 1 + |phi|: rounding, and what Newton's last step comes to
      const double from = y[lead.mass], to = trial[lead.mass];
      double phi = 0;
      if (!findCusp(system, lead.mass, from, to, phi)) return false;
      double tau = h * (phi - from) / (to - from);
      for (int round = 0; round < kRounds; ++round) {
        error = attempt(tau);
        const double miss = phi - trial[lead.mass];
        const double speed = trial[system.rates() + lead.mass] / c;
        if (std::abs(miss) <= kMet * (1 + std::abs(phi)) || speed == 0) break;
        tau += miss / speed;
        if (!(tau > 0 && tau <= h)) break;
      }
      if (!(std::abs(phi - trial[lead.mass]) < kNear * (1 + std::abs(phi)))) return false;
      trial[lead.mass] = phi;
      if (error > 1) h = tau;  // otherwise h stays: the way to a cusp may be too short for the time to move on behind it
      return true;
    }
    /// Shortens the sub-step of h, which leads beyond the end of the tick, to end there. Newton's method in tau, kept between bounds by
    /// halving.
    void endOnTick(double h, double& error) noexcept {
      constexpr int kRounds = 40;
      constexpr double kMet = 2e-16;  // of dt
      double low = 0, high = h, tau = h;
      for (int round = 0; round < kRounds && std::abs(trial[n] - dt) > kMet * dt; ++round) {
        (trial[n] > dt ? high : low) = tau;
        const double factor = system.speedAt(lead.mass, trial[lead.mass]) / c;
        double better = tau - (trial[n] - dt) / std::max(factor, kLeast);
        if (!(better > low && better < high)) better = 0.5 * (low + high);
        if (better == tau) break;
        tau = better;
        error = attempt(tau);
        if (error <= 1 && endInTime(system, hand, dt, lead.mass, trial, plain, rates, rhs)) break;
      }
    }
  };

  StepStatus pass(const System& system, const HandSegment& hand, double dt, const State& y0, State& next, std::uint64_t& rhs) noexcept {
    Passage p{system, hand, dt, tolerance_};
    const int n = p.n;
    for (int i = 0; i < n; ++i) p.y[i] = y0[i];
    p.y[n] = 0;
    StepStatus status = StepStatus::Ok;
    double h = last_ > 0 ? last_ : dt, growth = kGrowth;
    for (bool fresh = true; p.y[n] < dt;) {
      if (fresh) {
        if (!p.chooseLead()) return StepStatus::NoContinuation;
        h = p.limit(h);
        fresh = false;
      }
      double error = p.attempt(h);
      bool onCusp = p.crossesMinimum(error) && p.endOnCusp(h, error);
      bool finished = !onCusp && error <= 1 && endInTime(system, hand, dt, p.lead.mass, p.trial, p.plain, p.rates, p.rhs);
      if (!finished && error <= 1 && p.trial[n] >= dt) {
        p.endOnTick(h, error);
        finished = true;
        onCusp = false;
      }
      const double factor = dop853::growth(error, growth);
      if (error <= 1) {
        growth = kGrowth;
        if (!finished && !(p.trial[n] > p.y[n]) && !onCusp) {
          status = StepStatus::Capped;
          break;
        }
        p.y = p.trial;
        p.onCusp = onCusp;
        fresh = true;
        if (finished) {
          p.y[n] = dt;
          last_ = h * factor;
        }
      } else {
        growth = 1;
        status = std::isfinite(error) ? StepStatus::Capped : StepStatus::NotFinite;
      }
      if (!onCusp || error > 1) h *= factor;
      if (p.y[n] < dt && p.rhs + 2 * dop853::kStages > kMaxRhs) {
        status = StepStatus::Capped;
        break;
      }
    }
    rhs += static_cast<std::uint64_t>(p.rhs);
    if (p.y[n] < dt) {
      last_ = 0;
      return status == StepStatus::Ok ? StepStatus::Capped : status;
    }
    for (int i = 0; i < n; ++i) next[i] = p.y[i];
    return StepStatus::Ok;
  }

  /// The fictitious time in which `left` seconds pass, good to some thousandths. Simpson's rule over |r_phi| along phi + rate tau + turn
  /// tau^2/2. Infinite where the time cannot be reached.
  static double aim(const System& system, int mass, double phi, double rate, double turn, double left) noexcept {
    const double c = system.speedScale, begin = system.speedAt(mass, phi) / c;
    double tau = left / std::max(begin, 1e-3);
    for (int round = 0; round < 4; ++round) {
      const double half = system.speedAt(mass, phi + tau * (0.5 * rate + 0.125 * turn * tau)) / c;
      const double end = system.speedAt(mass, phi + tau * (rate + 0.5 * turn * tau)) / c;
      const double miss = tau / 6 * (begin + 4 * half + end) - left;
      if (std::abs(miss) < 1e-3 * left) return tau;
      tau -= miss / std::max(end, 1e-3);
      if (!(tau > 0)) break;
    }
    return std::numeric_limits<double>::infinity();
  }
  /// From `at`, whose time is nearly dt, to dt by one RK4 step in time, forwards or back. Only where the tangent turns so little that the
  /// error is below rounding: kTurn^5/120. Not where |r_phi| differs at the last stage.
  static bool endInTime(const System& system, const HandSegment& hand, double dt, int mass, Extended& at, State& plain, State& rates,
                        int& rhs) noexcept {
    constexpr double kTurn = 4e-3, kChange = 5 * kTurn;
    const int n = system.states();
    const double rest = dt - at[n];
    const constraints::CurvePoint p = evaluate(system.curveOf(mass), at[mass]);
    const double square = dot(p.rPhi, p.rPhi), speed = std::sqrt(square),
                 turn = norm(p.rPhiPhi) * std::abs(at[system.rates() + mass] * rest);
    if (!(turn < kTurn * square) || !(std::abs(rest) < 0.1 * dt)) return false;
    State sum(n), begin(n);
    for (int i = 0; i < n; ++i) begin[i] = plain[i] = at[i];
    system.rate(system.handAt(hand, at[n] / dt), plain, rates);
    if constexpr (System::kHas.sight)
      if (system.reach(plain, rates, std::abs(rest)) < std::abs(rest)) return false;
    sum = rates;
    for (const double share : {0.5, 0.5, 1.0}) {
      for (int i = 0; i < n; ++i) plain[i] = begin[i] + share * rest * rates[i];
      system.rate(system.handAt(hand, (at[n] + share * rest) / dt), plain, rates);
      for (int i = 0; i < n; ++i) sum[i] += (share < 1 ? 2 : 1) * rates[i];
    }
    rhs += 4;
    if (!(std::abs(system.speedAt(mass, plain[mass]) - speed) <= kChange * speed)) return false;
    for (int i = 0; i < n; ++i) at[i] = begin[i] + rest / 6 * sum[i];
    at[n] = dt;
    return true;
  }

  /// The minimum of |r_phi| between two values of phi where it falls and rises, by Gauss-Newton on r_phi = 0. True if the minimum is a
  /// cusp.
  static bool findCusp(const System& system, int mass, double from, double to, double& phi) noexcept {
    double low = std::min(from, to), high = std::max(from, to);
    phi = 0.5 * (low + high);
    for (int round = 0; round < 80 && high - low > 1e-16 * (std::abs(low) + std::abs(high)); ++round) {
      const constraints::CurvePoint p = evaluate(system.curveOf(mass), phi);
      const double s = dot(p.rPhi, p.rPhiPhi);
      if (s == 0) break;
      (s > 0 ? high : low) = phi;
      double better = phi - s / dot(p.rPhiPhi, p.rPhiPhi);
      if (!(better > low && better < high)) better = 0.5 * (low + high);
      if (better == phi) break;
      phi = better;
    }
    return system.speedAt(mass, phi) < kCusp * system.speedScale;
  }

  Adaptive<System> regular_;
  double tolerance_;
  double last_ = 0;  // size of the last sub-step in tau
};

}  // namespace reachlab::dynamics
