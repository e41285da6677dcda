#include "constraints/formula/interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/math/elementary.h"

namespace reachlab::constraints {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr Interval kEverything{-kInf, kInf};

Interval hull(std::initializer_list<double> values) { return {std::min(values), std::max(values)}; }

bool contains(Interval a, double x) { return a.lo <= x && x <= a.hi; }

// Powers of an interval with a whole exponent > 0.
Interval wholePower(Interval a, double n) {
  const double lo = elementary::pow(a.lo, n), hi = elementary::pow(a.hi, n);
  if (std::fmod(n, 2) != 0) return {lo, hi};
  return {contains(a, 0) ? 0.0 : std::min(lo, hi), std::max(lo, hi)};
}

// Sine or cosine, which is 1 at `crest` and every 2 pi from there.
Interval waveOver(double (*f)(double), double crest, Interval a) {
  constexpr double kTurn = 2 * std::numbers::pi;
  if (!(a.hi - a.lo < kTurn)) return {-1, 1};
  const auto holds = [&](double place) { return place + kTurn * std::ceil((a.lo - place) / kTurn) <= a.hi; };
  const double first = f(a.lo), last = f(a.hi);
  return {holds(crest + kTurn / 2) ? -1 : std::min(first, last), holds(crest) ? 1 : std::max(first, last)};
}

// Where the box meets neither the cut nor 0, the angle grows and falls along its sides.
Interval angleOver(Interval y, Interval x) {
  if (!(x.lo > 0 || y.lo > 0 || y.hi < 0)) return {-std::numbers::pi, std::numbers::pi};
  return hull({elementary::atan2(y.lo, x.lo), elementary::atan2(y.lo, x.hi), elementary::atan2(y.hi, x.lo), elementary::atan2(y.hi, x.hi)});
}

/// a^b; `finiteness` is raised to what is known of it.
Interval powerOver(const Interval& a, const Interval& b, Finiteness& finiteness) {
  const auto raise = [&](Finiteness to) { finiteness = std::max(finiteness, to); };
  const bool whole = b.lo == b.hi && b.lo == std::floor(b.lo);
  if (a.lo > 0)
    return hull({elementary::pow(a.lo, b.lo), elementary::pow(a.lo, b.hi), elementary::pow(a.hi, b.lo), elementary::pow(a.hi, b.hi)});
  if (whole && b.lo == 0) return {1, 1};
  if (whole && b.lo > 0) return wholePower(a, b.lo);
  if (whole && a.hi < 0) return hull({elementary::pow(a.lo, b.lo), elementary::pow(a.hi, b.lo)});
  if (!whole && a.hi < 0) {
    raise(Finiteness::Nowhere);
    return kEverything;
  }
  if (!whole && b.lo > 0) {
    raise(a.lo < 0 ? Finiteness::Touching : Finiteness::Finite);
    return {0, std::max({1.0, elementary::pow(std::max(a.hi, 0.0), b.lo), elementary::pow(std::max(a.hi, 0.0), b.hi)})};
  }
  raise(a.lo == 0 && a.hi == 0 ? Finiteness::Nowhere : Finiteness::Unknown);
  return kEverything;
}

}  // namespace

Interval product(Interval a, Interval b) {
  const auto times = [](double x, double y) { return x == 0 || y == 0 ? 0.0 : x * y; };
  return hull({times(a.lo, b.lo), times(a.lo, b.hi), times(a.hi, b.lo), times(a.hi, b.hi)});
}

Interval applyOver(Op op, Interval a, Interval b, int exponent, Finiteness& finiteness) {
  const auto raise = [&](Finiteness to) { finiteness = std::max(finiteness, to); };
  const auto monotone = [&](double (*function)(double)) { return Interval{function(a.lo), function(a.hi)}; };
  Interval r;
  switch (op) {
    case Op::Constant:
    case Op::Variable:
    case Op::Parameter: r = a; break;
    case Op::Add: r = {a.lo + b.lo, a.hi + b.hi}; break;
    case Op::Sub: r = {a.lo - b.hi, a.hi - b.lo}; break;
    case Op::Mul: r = product(a, b); break;
    case Op::Neg: r = {-a.hi, -a.lo}; break;
    case Op::Div:
      if (contains(b, 0)) {
        raise(b.lo == 0 && b.hi == 0 ? Finiteness::Nowhere : Finiteness::Unknown);
        r = kEverything;
      } else {
        r = product(a, {1 / b.hi, 1 / b.lo});
      }
      break;
    case Op::PowInt: r = wholePower(a, exponent); break;
    case Op::Pow: r = powerOver(a, b, finiteness); break;
    case Op::Sin: r = waveOver(elementary::sin, std::numbers::pi / 2, a); break;
    case Op::Cos: r = waveOver(elementary::cos, 0, a); break;
    case Op::Tan: {
      const double k = std::floor(a.lo / std::numbers::pi + 0.5);
      if (k != std::floor(a.hi / std::numbers::pi + 0.5)) {
        raise(Finiteness::Unknown);
        r = kEverything;
      } else {
        r = monotone(elementary::tan);
      }
      break;
    }
    case Op::Asin:
    case Op::Acos: {
      if (a.lo > 1 || a.hi < -1) raise(Finiteness::Nowhere);
      else if (a.lo < -1 || a.hi > 1) raise(Finiteness::Touching);
      const double lo = std::clamp(a.lo, -1.0, 1.0), hi = std::clamp(a.hi, -1.0, 1.0);
      r = op == Op::Asin ? Interval{elementary::asin(lo), elementary::asin(hi)} : Interval{elementary::acos(hi), elementary::acos(lo)};
      break;
    }
    case Op::Atan: r = monotone(elementary::atan); break;
    case Op::Atan2: r = angleOver(a, b); break;
    case Op::Sinh: r = monotone(elementary::sinh); break;
    case Op::Cosh:
      r = {contains(a, 0) ? 1.0 : std::min(elementary::cosh(a.lo), elementary::cosh(a.hi)),
           std::max(elementary::cosh(a.lo), elementary::cosh(a.hi))};
      break;
    case Op::Tanh: r = monotone(elementary::tanh); break;
    case Op::Exp: r = monotone(elementary::exp); break;
    case Op::Log:
      if (a.hi <= 0) raise(Finiteness::Nowhere);
      else if (a.lo <= 0) raise(Finiteness::Unknown);
      r = a.lo > 0 ? monotone(elementary::log) : kEverything;
      break;
    case Op::Sqrt:
      if (a.hi < 0) raise(Finiteness::Nowhere);
      else if (a.lo < 0) raise(Finiteness::Touching);
      r = {std::sqrt(std::max(a.lo, 0.0)), std::sqrt(std::max(a.hi, 0.0))};
      break;
    case Op::Abs: r = {contains(a, 0) ? 0.0 : std::min(std::abs(a.lo), std::abs(a.hi)), std::max(std::abs(a.lo), std::abs(a.hi))}; break;
    case Op::Sign: r = {a.lo > 0 ? 1.0 : a.lo == 0 ? 0.0 : -1.0, a.hi < 0 ? -1.0 : a.hi == 0 ? 0.0 : 1.0}; break;
  }
  if (!(std::isfinite(r.lo) && std::isfinite(r.hi))) {
    raise(Finiteness::Unknown);
    if (std::isnan(r.lo) || std::isnan(r.hi)) r = kEverything;
    if (r.lo == r.hi) raise(Finiteness::Nowhere);  // infinite for sure
  }
  return r;
}

IntervalEvaluator::IntervalEvaluator(const ExpressionGraph& graph, std::span<const int> roots, const double* shape)
    : list_(graph.operationsFor(roots, shape)), bounds_(list_.operations.size()), result_(roots.size()) {}

const std::vector<Finiteness>& IntervalEvaluator::evaluate(const std::array<Interval, 2>& box) {
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    const ExpressionNode& n = list_.operations[i];
    Bound a, b;
    if (n.op == Op::Constant) a.range = {n.value, n.value};
    else if (n.op == Op::Variable) a.range = box[n.a];
    else a = bounds_[n.a];
    if (operandCount(n.op) == 2) b = bounds_[n.b];
    bounds_[i].finiteness = std::max(a.finiteness, b.finiteness);
    bounds_[i].range = applyOver(n.op, a.range, b.range, n.b, bounds_[i].finiteness);
  }
  for (std::size_t k = 0; k < result_.size(); ++k) result_[k] = bounds_[list_.roots[k]].finiteness;
  return result_;
}

}  // namespace reachlab::constraints
