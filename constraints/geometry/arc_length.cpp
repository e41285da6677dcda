#include "constraints/geometry/arc_length.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/math/gauss_legendre.h"
#include "constraints/constraint.h"

namespace reachlab::constraints {
namespace {

constexpr int kFirstLengths = 8;
constexpr int kDeepestLength = 50;         // halvings
constexpr double kResolvedLength = 1e-13;  // the last two terms of a piece, of its first
constexpr double kSmall = 1e-15;           // the same, of the whole length
constexpr double kNoPart = 1e-16;          // of the whole length: a piece that is no longer halved

}  // namespace

ArcLength::ArcLength(const Constraint& curve, double from, double to) {
  if (curve.kind != ConstraintKind::Curve) throw RefusedError(curve.name + " is no curve");
  constexpr int kProbes = 256;
  for (int i = 0; i < kProbes; ++i)
    rough_ += norm(evaluate(curve.curve, from + (to - from) * (i + 0.5) / kProbes).rPhi) * std::abs(to - from) / kProbes;
  for (int i = 0; i < kFirstLengths; ++i)
    append(curve, from + (to - from) * i / kFirstLengths, from + (to - from) * (i + 1) / kFirstLengths, 0);
}

void ArcLength::append(const Constraint& curve, double begin, double end, int depth) {
  const GaussRule& rule = gaussRule16();
  Piece piece{begin, (end - begin) / 2, length_, {}, {}};
  std::vector<double> rate;
  for (const double x : rule.node) rate.push_back(norm(evaluate(curve.curve, begin + piece.half * (x + 1)).rPhi) * std::abs(piece.half));
  piece.rate = projectOnLegendre(rate, rule.node, rule.weight);
  const size_t n = piece.rate.size();
  const double most = std::max(std::abs(piece.rate[n - 1]), std::abs(piece.rate[n - 2])), whole = 2 * piece.rate[0];
  if (!std::isfinite(whole) && depth == kDeepestLength)
    throw RefusedError("the curve has no value, or no end to its length, near phi = " + std::to_string(begin));
  const bool resolved =
      std::isfinite(whole) && (most <= std::max(kResolvedLength * piece.rate[0], kSmall * rough_) || whole <= kNoPart * rough_);
  if (!resolved && depth < kDeepestLength) {
    const double middle = (begin + end) / 2;
    append(curve, begin, middle, depth + 1);
    append(curve, middle, end, depth + 1);
    return;
  }
  if (static_cast<int>(pieces_.size()) == kMaxPieces)
    throw RefusedError("the curve bends too often between start and target for its arc length: allowed: a shorter part of it");
  piece.done = integralOf(piece.rate);
  length_ += whole;
  pieces_.push_back(std::move(piece));
}

double ArcLength::parameterAt(double s) const {
  const auto next =
      std::upper_bound(pieces_.begin(), pieces_.end(), s, [](double value, const Piece& piece) { return value < piece.from; });
  const Piece& piece = next == pieces_.begin() ? pieces_.front() : *(next - 1);
  double lo = -1, hi = 1, x = 0;
  constexpr int kPasses = 60;
  for (int pass = 0; pass < kPasses; ++pass) {
    const double off = piece.from + valueAt(piece.done, x) - s, rate = valueAt(piece.rate, x);
    (off > 0 ? hi : lo) = x;
    double better = x - off / rate;
    if (!(better >= lo && better <= hi)) better = (lo + hi) / 2;
    const double step = std::abs(better - x);
    x = better;
    if (step < 1e-15) break;
  }
  return piece.begin + piece.half * (x + 1);
}

std::optional<double> parameterAfter(const Constraint& curve, double from, double s) {
  if (!(std::abs(s) > 0)) return from;
  const Domain& domain = curve.domain[0];
  const double end = domain.periodic ? std::copysign(std::numeric_limits<double>::infinity(), s) : s > 0 ? domain.hi : domain.lo;
  // A piece that is longer than s: twice as much of the parameter each time.
  double part = 2 * std::abs(s) / std::max(norm(evaluate(curve.curve, from).rPhi), 1e-6);
  constexpr int kMostDoublings = 40;
  for (int i = 0; i < kMostDoublings; ++i, part *= 2) {
    const double to = s > 0 ? std::min(from + part, end) : std::max(from - part, end);
    try {
      const ArcLength way(curve, from, to);
      if (way.length() >= std::abs(s)) return way.parameterAt(std::abs(s));
    } catch (const RefusedError&) {
      if (to == end && i > 0) return std::nullopt;  // no value, or no end to its length, there
    }
    if (to == end) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace reachlab::constraints
