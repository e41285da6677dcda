#include "analysis/conclusions/movement_fit.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/math/lanes.h"

namespace reachlab::analysis {
namespace {

constexpr double kSmallStep = 1e-10;  // of the duration: the fit has arrived

/// Sums over the window that both the cost and the normal equations are made of. a: d phi / d s, b: phi's change with ln T at a held
/// centre, p: phi, v: the data. Of one sample after another, or of several side by side.
template <class Number>
struct SumsOf {
  Number aa{}, ab{}, ap{}, av{}, bb{}, bp{}, bv{}, pp{}, pv{};
  void add(const Number& slope, const Number& b, const Number& value, const Number& w, const Number& v) {
    const Number wa = w * slope, wb = w * b, wp = w * value;
    aa += wa * slope, ab += wa * b, ap += wa * value, av += wa * v;
    bb += wb * b, bp += wb * value, bv += wb * v;
    pp += wp * value, pv += wp * v;
  }
};
using Sums = SumsOf<double>;

using Cubic = std::array<double, 4>;  // c0 + d (c1 + d (c2 + d c3))

/// The cubic between sample i and i + 1, slopes of fourth order.
inline Cubic cubicOf(const double* f) {
  const double m0 = (8 * (f[1] - f[-1]) - (f[2] - f[-2])) / 12, m1 = (8 * (f[2] - f[0]) - (f[3] - f[-1])) / 12;
  return {f[0], m0, 3 * (f[1] - f[0]) - 2 * m0 - m1, 2 * (f[0] - f[1]) + m0 + m1};
}
template <class Number, class Coefficients>
Number valueOf(const Coefficients& c, const Number& d) {
  return c[0] + d * (c[1] + d * (c[2] + d * c[3]));
}
template <class Number, class Coefficients>
Number slopeOf(const Coefficients& c, const Number& d) {
  return c[1] + d * (2.0 * c[2] + d * 3.0 * c[3]);
}

constexpr std::ptrdiff_t kAside = 2;  // samples that a piece needs on either side
constexpr int kSamplesAtOnce = 4;     // samples side by side
using FourSamples = Lanes<kSamplesAtOnce>;

/// Each coefficient of four cubics.
std::array<FourSamples, 4> sideBySide(const Cubic& a, const Cubic& b, const Cubic& c, const Cubic& d) {
  return {FourSamples{a[0], b[0], c[0], d[0]}, FourSamples{a[1], b[1], c[1], d[1]}, FourSamples{a[2], b[2], c[2], d[2]},
          FourSamples{a[3], b[3], c[3], d[3]}};
}

/// `pieceAt(i)`: the cubic between samples i and i + 1 of phi. `changeAt(i)`: that of d phi / d ln T, or nothing for a plan that is held.
template <typename PieceAt, typename ChangeAt>
Sums sumOver(const FitWindow& window, double first, double spacing, std::ptrdiff_t cells, double centre, double duration, PieceAt&& pieceAt,
             ChangeAt&& changeAt) {
  constexpr bool kChanges = !std::is_same_v<std::decay_t<ChangeAt>, std::nullptr_t>;
  Sums s;
  if (cells < 6) return s;
  const double perStep = 1 / spacing;
  // x = place on the grid of sample k = x0 + k dx; only cells with two neighbours on either side (the rest of the grid is 0).
  const double dx = perStep / (window.rate * duration);
  const double x0 = ((window.begin - centre) / duration + 0.5 - first) * perStep;
  const double lowest = kAside, highest = static_cast<double>(cells - 1 - kAside) - 1e-9;
  const auto n = static_cast<double>(window.velocity.size());
  const auto from = static_cast<std::ptrdiff_t>(std::clamp(std::ceil((lowest - x0) / dx), 0.0, n));
  const auto to = static_cast<std::ptrdiff_t>(std::clamp(std::floor((highest - x0) / dx) + 1, 0.0, n));
  const double* const weight = window.weight.data();
  const double* const velocity = window.velocity.data();
  const auto placeOf = [&](std::ptrdiff_t k) { return x0 + static_cast<double>(k) * dx; };
  SumsOf<FourSamples> four;
  std::ptrdiff_t k = from;
  for (; k + kSamplesAtOnce <= to; k += kSamplesAtOnce) {
    const double x[] = {placeOf(k), placeOf(k + 1), placeOf(k + 2), placeOf(k + 3)};
    const std::ptrdiff_t i[] = {static_cast<std::ptrdiff_t>(x[0]), static_cast<std::ptrdiff_t>(x[1]), static_cast<std::ptrdiff_t>(x[2]),
                                static_cast<std::ptrdiff_t>(x[3])};
    const auto apart = [&](int lane) { return x[lane] - static_cast<double>(i[lane]); };
    const FourSamples d{apart(0), apart(1), apart(2), apart(3)}, place{x[0], x[1], x[2], x[3]};
    const std::array<FourSamples, 4> piece = sideBySide(pieceAt(i[0]), pieceAt(i[1]), pieceAt(i[2]), pieceAt(i[3]));
    const FourSamples slope = perStep * slopeOf(piece, d), fromMiddle = first + place * spacing - 0.5;
    FourSamples b = -slope * fromMiddle;
    if constexpr (kChanges) b += valueOf(sideBySide(changeAt(i[0]), changeAt(i[1]), changeAt(i[2]), changeAt(i[3])), d);
    four.add(slope, b, valueOf(piece, d), loadLanes<FourSamples>(weight + k), loadLanes<FourSamples>(velocity + k));
  }
  for (; k < to; ++k) {
    const double x = placeOf(k);
    const auto i = static_cast<std::ptrdiff_t>(x);
    const double d = x - static_cast<double>(i);
    const Cubic& piece = pieceAt(i);
    const double slope = perStep * slopeOf(piece, d), fromMiddle = first + x * spacing - 0.5;
    double b = -slope * fromMiddle;
    if constexpr (kChanges) b += valueOf(changeAt(i), d);
    s.add(slope, b, valueOf(piece, d), weight[k], velocity[k]);
  }
  const auto join = [](double& sum, const FourSamples& lanes) { sum += (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); };
  join(s.aa, four.aa), join(s.ab, four.ab), join(s.ap, four.ap), join(s.av, four.av);
  join(s.bb, four.bb), join(s.bp, four.bp), join(s.bv, four.bv), join(s.pp, four.pp), join(s.pv, four.pv);
  return s;
}

struct Step {
  double centre = 0, logDuration = 0;
  bool solved = false;
};

/// Marquardt's damped step from the sums at (duration, amplitude).
Step stepFrom(const Sums& s, double duration, double amplitude, double damping) {
  const double ja = -amplitude / duration;  // columns: ja * a, amplitude * b, p
  double h[3][3] = {{ja * ja * s.aa, ja * amplitude * s.ab, ja * s.ap},
                    {ja * amplitude * s.ab, amplitude * amplitude * s.bb, amplitude * s.bp},
                    {ja * s.ap, amplitude * s.bp, s.pp}};
  double g[3] = {ja * (s.av - amplitude * s.ap), amplitude * (s.bv - amplitude * s.bp), s.pv - amplitude * s.pp};
  for (int i = 0; i < 3; ++i) h[i][i] *= 1 + damping;
  // Cholesky.
  double l[3][3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = h[i][j];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j) {
        if (!(sum > 0)) return {};
        l[i][i] = std::sqrt(sum);
      } else {
        l[i][j] = sum / l[j][j];
      }
    }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < i; ++k) g[i] -= l[i][k] * g[k];
    g[i] /= l[i][i];
  }
  for (int i = 2; i >= 0; --i) {
    for (int k = i + 1; k < 3; ++k) g[i] -= l[k][i] * g[k];
    g[i] /= l[i][i];
  }
  return {g[0], g[1], std::isfinite(g[0]) && std::isfinite(g[1])};
}

/// `evaluate(centre, duration, sums)` false: not possible there.
template <typename Evaluate>
MovementFit descend(const FitWindow& window, const MovementFit& start, FitEffort effort, Evaluate&& evaluate) {
  const double rest = restCost(window);
  MovementFit fit = start;
  fit.found = false;
  double centre = start.onset + start.duration / 2, duration = start.duration;
  Sums sums;
  if (!(duration > 0) || !evaluate(centre, duration, sums)) return fit;
  const auto costOf = [&](const Sums& s) { return s.pp > 0 ? std::max(0.0, rest - s.pv * s.pv / s.pp) : rest; };
  double cost = costOf(sums), damping = 1e-4;
  for (int i = 0; i < effort.steps && sums.pp > 0; ++i) {
    const double amplitude = sums.pv / sums.pp;
    const Step step = stepFrom(sums, duration, amplitude, damping);
    if (!step.solved) break;
    const double nextCentre = centre + std::clamp(step.centre, -0.1 * duration, 0.1 * duration);
    const double nextDuration = duration * std::exp(std::clamp(step.logDuration, -0.15, 0.15));
    Sums next;
    const bool possible = evaluate(nextCentre, nextDuration, next);
    const double nextCost = possible ? costOf(next) : rest;
    const bool small = std::abs(step.centre) < kSmallStep * duration && std::abs(step.logDuration) < kSmallStep;
    if (possible && nextCost <= cost) {
      const bool arrived = cost - nextCost <= effort.improvement * cost && std::abs(step.logDuration) < 1e-5;
      centre = nextCentre, duration = nextDuration, sums = next, cost = nextCost, damping *= 0.1;
      if (small || arrived) break;
    } else {
      damping = std::max(damping, 1e-6) * 8;
      if (small || damping > 1e8) break;
    }
  }
  fit.onset = centre - duration / 2;
  fit.duration = duration;
  fit.amplitude = sums.pp > 0 ? sums.pv / sums.pp : 0;
  fit.cost = cost;
  fit.found = true;
  return fit;
}

template <typename Weight>
ProfileMoments momentsOf(std::size_t n, double first, double step, Weight&& weight) {
  double sum = 0, mean = 0, squares = 0;
  for (std::size_t i = 0; i < n; ++i) sum += weight(i), mean += weight(i) * static_cast<double>(i);
  if (!(sum > 0)) return {};
  mean /= sum;
  for (std::size_t i = 0; i < n; ++i) squares += weight(i) * (static_cast<double>(i) - mean) * (static_cast<double>(i) - mean);
  return {first + step * mean, step * std::sqrt(squares / sum)};
}

}  // namespace

ProfileMoments momentsOf(const Profile& profile) {
  return momentsOf(profile.value.size(), profile.first, profile.step, [&](std::size_t i) { return profile.value[i] * profile.value[i]; });
}

ProfileMoments momentsOf(const FitWindow& window) {
  return momentsOf(window.velocity.size(), window.begin, 1 / window.rate,
                   [&](std::size_t i) { return window.velocity[i] * window.velocity[i]; });
}

MovementFit startFrom(const ProfileMoments& window, const ProfileMoments& profile, double factor) {
  MovementFit start;
  if (!(profile.width > 0)) return start;
  start.duration = factor * window.width / profile.width;
  start.onset = window.centre - start.duration * profile.centre;
  return start;
}

ProfilePieces::ProfilePieces(const Profile& profile) : first(profile.first), step(profile.step) {
  for (std::ptrdiff_t i = kAside; i + 1 + kAside < static_cast<std::ptrdiff_t>(profile.value.size()); ++i)
    c.push_back(cubicOf(profile.value.data() + i));
}

MovementFit fitMovement(const FitWindow& window, const ProfilePieces& pieces, const MovementFit& start, FitEffort effort) {
  const auto cells = static_cast<std::ptrdiff_t>(pieces.c.size()) + 1 + 2 * kAside;
  return descend(window, start, effort, [&](double centre, double duration, Sums& sums) {
    sums = sumOver(
        window, pieces.first, pieces.step, cells, centre, duration,
        [&](std::ptrdiff_t i) -> const Cubic& { return pieces.c[static_cast<std::size_t>(i - kAside)]; }, nullptr);
    return true;
  });
}

MovementFit fitMovement(const FitWindow& window, const Profile& profile, const MovementFit& start, FitEffort effort) {
  return fitMovement(window, ProfilePieces(profile), start, effort);
}

MovementFit fitMovement(const FitWindow& window, const ProfileFamily& family, const MovementFit& start, Profile& scratch,
                        FitEffort effort) {
  MovementFit fit = descend(window, start, effort, [&](double centre, double duration, Sums& sums) {
    if (!family.at(duration, scratch)) return false;
    sums = sumOver(
        window, scratch.first, scratch.step, static_cast<std::ptrdiff_t>(scratch.value.size()), centre, duration,
        [&](std::ptrdiff_t i) { return cubicOf(scratch.value.data() + i); },
        [&](std::ptrdiff_t i) { return cubicOf(scratch.change.data() + i); });
    return true;
  });
  if (fit.found) family.at(fit.duration, scratch);
  return fit;
}

std::vector<double> residualsOf(const FitWindow& window, const Profile& profile, const MovementFit& fit) {
  std::vector<double> out(window.velocity);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] -= fit.amplitude * profile.at((window.begin + static_cast<double>(i) / window.rate - fit.onset) / fit.duration);
  return out;
}

double restCost(const FitWindow& window) {
  double sum = 0;
  for (std::size_t i = 0; i < window.velocity.size(); ++i) sum += window.weight[i] * window.velocity[i] * window.velocity[i];
  return sum;
}

}  // namespace reachlab::analysis
