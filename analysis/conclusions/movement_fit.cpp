#include "analysis/conclusions/movement_fit.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "base/math/lanes.h"
#include "base/math/matrix.h"

namespace reachlab::analysis {
namespace {

constexpr double kSmallStep = 1e-10;  // of the duration: the fit has arrived

/// What the fit needs of the profile at one sample, or at several side by side.
template <class Number>
struct ProfileAt {
  Number value;       // phi
  Number slope;       // d phi / d s
  Number bend;        // d^2 phi / d s^2
  Number fromMiddle;  // s - 1/2
  Number change;      // of phi with ln T at a held centre
};

/// Sums over the window that the cost, its gradient and its second derivatives are made of. a: d phi / d s, b: phi's change with ln T at a held
/// centre, p: phi, v: the data, and c, d, e: d^2 phi / d s^2 times 1, s - 1/2 and (s - 1/2)^2.
template <class Number>
struct SumsOf {
  Number aa{}, ab{}, ap{}, av{}, bb{}, bp{}, bv{}, pp{}, pv{}, cp{}, cv{}, dp{}, dv{}, ep{}, ev{};
  void add(const ProfileAt<Number>& at, const Number& w, const Number& v) {
    const auto& [value, slope, bend, fromMiddle, b] = at;
    const Number wa = w * slope, wb = w * b, wp = w * value, wc = w * bend, wd = wc * fromMiddle, we = wd * fromMiddle;
    aa += wa * slope, ab += wa * b, ap += wa * value, av += wa * v;
    bb += wb * b, bp += wb * value, bv += wb * v;
    pp += wp * value, pv += wp * v;
    cp += wc * value, cv += wc * v, dp += wd * value, dv += wd * v, ep += we * value, ev += we * v;
  }
};
using Sums = SumsOf<double>;

using Cubic = std::array<double, 4>;  // c0 + d (c1 + d (c2 + d c3))

/// The cubic behind the sample f0, with slopes of fourth order: of one sample, or of several side by side.
template <class Number>
std::array<Number, 4> cubicOf(const Number& beforeLast, const Number& before, const Number& f0, const Number& f1, const Number& after,
                              const Number& afterNext) {
  const Number m0 = (8.0 * (f1 - before) - (after - beforeLast)) / 12.0, m1 = (8.0 * (after - f0) - (afterNext - before)) / 12.0;
  return {f0, m0, 3.0 * (f1 - f0) - 2.0 * m0 - m1, 2.0 * (f0 - f1) + m0 + m1};
}
Cubic cubicOf(const double* f) { return cubicOf(f[-2], f[-1], f[0], f[1], f[2], f[3]); }

template <class Number, class Coefficients>
Number valueOf(const Coefficients& c, const Number& d) {
  return c[0] + d * (c[1] + d * (c[2] + d * c[3]));
}
template <class Number, class Coefficients>
Number slopeOf(const Coefficients& c, const Number& d) {
  return c[1] + d * (2.0 * c[2] + d * 3.0 * c[3]);
}

template <class Number, class Coefficients>
Number bendOf(const Coefficients& c, const Number& d) {
  return 2.0 * c[2] + d * 6.0 * c[3];
}

constexpr std::ptrdiff_t kAside = 2;  // samples that a piece needs on either side
constexpr int kSamplesAtOnce = 4;     // samples side by side
using FourSamples = Lanes<kSamplesAtOnce>;

using FourCells [[gnu::vector_size(kSamplesAtOnce * sizeof(int))]] = int;

/// The cells that four places lie in, and how far behind the cells' samples the places are.
std::pair<FourCells, FourSamples> splitPlaces(const FourSamples& place) {
#ifdef __AVX__
  const FourCells i = __builtin_convertvector(place, FourCells);
  return {i, place - __builtin_convertvector(i, FourSamples)};
#else
  const FourCells i{static_cast<int>(place[0]), static_cast<int>(place[1]), static_cast<int>(place[2]), static_cast<int>(place[3])};
  return {i,
          place - FourSamples{static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2]), static_cast<double>(i[3])}};
#endif
}

/// Four numbers from each of four places, the first of all side by side, then the second of all …
std::array<FourSamples, 4> sideBySide(const double* a, const double* b, const double* c, const double* d) {
#ifdef __AVX__
  const FourSamples ra = loadLanes<FourSamples>(a), rb = loadLanes<FourSamples>(b), rc = loadLanes<FourSamples>(c),
                    rd = loadLanes<FourSamples>(d);
  const FourSamples even = __builtin_shufflevector(ra, rb, 0, 4, 2, 6), odd = __builtin_shufflevector(ra, rb, 1, 5, 3, 7),
                    evenToo = __builtin_shufflevector(rc, rd, 0, 4, 2, 6), oddToo = __builtin_shufflevector(rc, rd, 1, 5, 3, 7);
  return {__builtin_shufflevector(even, evenToo, 0, 1, 4, 5), __builtin_shufflevector(odd, oddToo, 0, 1, 4, 5),
          __builtin_shufflevector(even, evenToo, 2, 3, 6, 7), __builtin_shufflevector(odd, oddToo, 2, 3, 6, 7)};
#else
  return {FourSamples{a[0], b[0], c[0], d[0]}, FourSamples{a[1], b[1], c[1], d[1]}, FourSamples{a[2], b[2], c[2], d[2]},
          FourSamples{a[3], b[3], c[3], d[3]}};
#endif
}

/// The cubics between the samples i and i + 1 of a profile whose cubics are known.
struct KnownPieces {
  const ProfilePieces& pieces;
  const double* place(std::ptrdiff_t i) const { return pieces.c[static_cast<std::size_t>(i - kAside)].data(); }
  const Cubic& at(std::ptrdiff_t i) const { return pieces.c[static_cast<std::size_t>(i - kAside)]; }
  std::array<FourSamples, 4> at(const FourCells& i) const { return sideBySide(place(i[0]), place(i[1]), place(i[2]), place(i[3])); }
};
/// The same of a profile that is used once.
struct FreshPieces {
  const double* f;
  Cubic at(std::ptrdiff_t i) const { return cubicOf(f + i); }
  std::array<FourSamples, 4> at(const FourCells& i) const {
    const auto beside = [&](std::ptrdiff_t by) { return FourSamples{f[i[0] + by], f[i[1] + by], f[i[2] + by], f[i[3] + by]}; };
    const auto [before, f0, f1, after] = sideBySide(f + i[0] - 1, f + i[1] - 1, f + i[2] - 1, f + i[3] - 1);
    return cubicOf(beside(-2), before, f0, f1, after, beside(3));
  }
};

/// `pieces`: the cubics of phi. `changes`: those of d phi / d ln T, or nothing for a plan that is held.
template <typename Pieces, typename Changes>
Sums sumOver(const FitWindow& window, double first, double spacing, std::ptrdiff_t cells, double centre, double duration,
             const Pieces& pieces, const Changes& changes) {
  constexpr bool kChanges = !std::is_same_v<Changes, std::nullptr_t>;
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
  // `place` on the grid is `d` behind the sample of the cell or cells `i`.
  const auto profileAt = [&]<class Number>(const Number& place, const Number& d, const auto& i) {
    const auto piece = pieces.at(i);
    ProfileAt<Number> at{
        valueOf(piece, d), perStep * slopeOf(piece, d), perStep * perStep * bendOf(piece, d), first + place * spacing - 0.5, {}};
    at.change = -at.slope * at.fromMiddle;
    if constexpr (kChanges) at.change += valueOf(changes.at(i), d);
    return at;
  };
  SumsOf<FourSamples> four;
  std::ptrdiff_t k = from;
  for (; k + kSamplesAtOnce <= to; k += kSamplesAtOnce) {
    const FourSamples place = x0 + (static_cast<double>(k) + FourSamples{0.0, 1.0, 2.0, 3.0}) * dx;
    const auto [i, d] = splitPlaces(place);
    four.add(profileAt(place, d, i), loadLanes<FourSamples>(weight + k), loadLanes<FourSamples>(velocity + k));
  }
  for (; k < to; ++k) {
    const double place = x0 + static_cast<double>(k) * dx;
    const auto i = static_cast<std::ptrdiff_t>(place);
    s.add(profileAt(place, place - static_cast<double>(i), i), weight[k], velocity[k]);
  }
  const auto join = [](double& sum, const FourSamples& lanes) { sum += (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); };
  join(s.aa, four.aa), join(s.ab, four.ab), join(s.ap, four.ap), join(s.av, four.av);
  join(s.bb, four.bb), join(s.bp, four.bp), join(s.bv, four.bv), join(s.pp, four.pp), join(s.pv, four.pv);
  join(s.cp, four.cp), join(s.cv, four.cv), join(s.dp, four.dp), join(s.dv, four.dv), join(s.ep, four.ep), join(s.ev, four.ev);
  return s;
}

struct Step {
  double centre = 0, logDuration = 0;
  bool solved = false;
};

/// Newton's step from the sums at (duration, amplitude), damped as by Marquardt. Where the cost does not curve upwards, it is the step of Gauss and
/// Newton. A plan for another duration also has a profile of another shape. The second derivatives ignore that.
Step stepFrom(const Sums& s, double duration, double amplitude, double damping) {
  const double A = amplitude, T = duration;
  // Sums over the residuals v - A phi.
  const double ar = s.av - A * s.ap, br = s.bv - A * s.bp, pr = s.pv - A * s.pp;
  const double cr = s.cv - A * s.cp, dr = s.dv - A * s.dp, er = s.ev - A * s.ep;
  const Eigen::Vector3d gradient(-A / T * ar, A * br, pr);  // by centre, ln T and amplitude
  Eigen::Matrix3d slopes, bends;
  slopes << A * A / (T * T) * s.aa, -A * A / T * s.ab, -A / T * s.ap,  //
      -A * A / T * s.ab, A * A * s.bb, A * s.bp,                       //
      -A / T * s.ap, A * s.bp, s.pp;
  bends << A / (T * T) * cr, A / T * (dr + ar), -ar / T,  //
      A / T * (dr + ar), A * (er - br), br,               //
      -ar / T, br, 0;
  for (Eigen::Matrix3d hessian : {Eigen::Matrix3d(slopes - bends), slopes}) {
    hessian.diagonal() *= 1 + damping;
    const Eigen::LLT<Eigen::Matrix3d> factors(hessian);
    if (factors.info() != Eigen::Success) continue;
    const Eigen::Vector3d step = factors.solve(gradient);
    if (std::isfinite(step[0]) && std::isfinite(step[1])) return {step[0], step[1], true};
  }
  return {};
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
    sums = sumOver(window, pieces.first, pieces.step, cells, centre, duration, KnownPieces{pieces}, nullptr);
    return true;
  });
}

MovementFit fitMovement(const FitWindow& window, const Profile& profile, const MovementFit& start, FitEffort effort) {
  return fitMovement(window, ProfilePieces(profile), start, effort);
}

MovementFit fitMovement(const FitWindow& window, const ProfileFamily& family, const MovementFit& start, Profile& scratch,
                        FitEffort effort) {
  return descend(window, start, effort, [&](double centre, double duration, Sums& sums) {
    if (!family.at(duration, scratch)) return false;
    sums = sumOver(window, scratch.first, scratch.step, static_cast<std::ptrdiff_t>(scratch.value.size()), centre, duration,
                   FreshPieces{scratch.value.data()}, FreshPieces{scratch.change.data()});
    return true;
  });
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
