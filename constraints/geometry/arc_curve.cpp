#include "constraints/geometry/arc_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/math/gauss_legendre.h"
#include "base/math/legendre_series.h"
#include "constraints/regularity/places.h"

namespace reachlab::constraints {
namespace {

constexpr int kFirstPieces = 6;      // of the way
constexpr int kDeepest = 24;         // halvings of a piece; what is still not smooth then is a cusp
constexpr double kBeyond = 0.5;      // of the way, before the start and behind the target
constexpr double kResolved = 2e-13;  // the last two terms of a piece, of its largest
constexpr double kNoise = 1e-14;     // the same, of the piece's length, for what is nearly straight
constexpr int kProbes = 400;         // for places where the curve is run slowly
constexpr double kCusp = 1e6;        // fastest to slowest run from which it stands still
constexpr const char* kCuspWords = "a cusp, or a place where it stands still,";
constexpr int kChecks = 4000;     // places between start and target where the pieces are held against the formula
constexpr double kFits = 1e-10;   // of a piece's length: it goes through them
constexpr double kPlace = 1e-13;  // of a place's coordinates: their rounding
constexpr double kTurns = 1e-6;   // between the tangents of two pieces that meet, or of the sharper curvature

[[noreturn]] void refuse(const CurveBreak& found) {
  throw RefusedError(
      fmt::format("the curve has {} at phi = {:.6g}, between start and target: no movement of finite jerk passes it but at "
                  "rest; allowed: a start and a target with none between them",
                  found.what, found.phi));
}

double degreesBetween(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(dot(a, b) / (norm(a) * norm(b)), -1.0, 1.0)) * 180 / std::numbers::pi;
}

/// The places of the formula between start and target decide, however narrow they are, where their list is complete.
void refuseAtPlaces(const Constraint& c, double start, double target) {
  const double lo = std::min(start, target), hi = std::max(start, target);
  const CurveRegularity regularity = computeRegularityWithin(c, lo, hi);
  for (std::size_t i = 0; i + 1 < regularity.pieces.size(); ++i) {
    const CurvePiece &before = regularity.pieces[i], &after = regularity.pieces[i + 1];
    if (before.placeAtHi < 0 || before.placeAtHi != after.placeAtLo) continue;
    const Place& place = regularity.places[before.placeAtHi];
    if (place.kind == PlaceKind::Hole) continue;
    const CurvePoint a = evaluate(before.curve, place.at), b = evaluate(after.curve, place.at);
    const std::string because = fmt::format(" ({})", place.because);
    if (!isPassed(place.kind))
      refuse({place.at, place.kind == PlaceKind::Jump ? fmt::format("a jump of {:.3g} m{}", norm(b.r - a.r), because)
                                                      : fmt::format("a {}{}", nameOf(place.kind), because)});
    const double speedA = norm(a.rPhi), speedB = norm(b.rPhi);
    if (!(speedA > 0) || !(speedB > 0)) continue;  // a cusp, or what stands still: told apart below
    const auto bend = [](const CurvePoint& p) {
      const double square = dot(p.rPhi, p.rPhi);
      return (p.rPhiPhi - (dot(p.rPhi, p.rPhiPhi) / square) * p.rPhi) / square;
    };
    if (!(norm(a.rPhi / speedA - b.rPhi / speedB) <= kTurns))
      refuse(
          {place.at, fmt::format("a kink (its direction turns by {:.3g} degrees at {})", degreesBetween(a.rPhi, b.rPhi), place.because)});
    const Vec3 bendA = bend(a), bendB = bend(b);
    if (!(norm(bendA - bendB) <= kTurns * std::max(norm(bendA), norm(bendB))))
      refuse({place.at, fmt::format("a step of its curvature{}", because)});
  }
}

bool isResolved(const LegendreSeries& series, double enough) {
  const size_t n = series.size();
  return std::max(std::abs(series[n - 1]), std::abs(series[n - 2])) <= enough;
}

// Powers of x of the Legendre polynomials: power[n][k].
template <int Count>
constexpr std::array<std::array<double, Count>, Count> legendrePowers() {
  std::array<std::array<double, Count>, Count> power{};
  power[0][0] = 1;
  power[1][1] = 1;
  for (int n = 1; n + 1 < Count; ++n)
    for (int k = 0; k <= n + 1; ++k) power[n + 1][k] = ((2 * n + 1) * (k > 0 ? power[n][k - 1] : 0.0) - n * power[n - 1][k]) / (n + 1);
  return power;
}

}  // namespace

ArcCurve::ArcCurve(const Constraint& curve, double start, double target, Along along)
    : along_(along), curve_(curve.curve), way_(target - start) {
  double slowest = INFINITY, fastest = 0, stillAt = start;
  for (int i = 0; i <= kProbes; ++i) {
    const double phi = start + way_ * i / kProbes, speed = norm(evaluate(curve_, phi).rPhi);
    if (!std::isfinite(speed)) refuse({phi, "no finite speed (|r_phi| grows without bound, or the formula has no value there)"});
    if (!(speed >= slowest)) slowest = speed, stillAt = phi;
    fastest = std::max(fastest, speed);
  }
  fastest_ = fastest;
  refuseAtPlaces(curve, start, target);
  if (!(fastest / slowest < kCusp)) refuse({stillAt, kCuspWords});
  for (int i = 0; i < kFirstPieces; ++i)
    if (!append(start + way_ * i / kFirstPieces, start + way_ * (i + 1) / kFirstPieces, 0)) refuse(break_);
  length_ = pieces_.back().to;
  if (countJoined() < pieces_.size()) refuse(break_);
  std::vector<Piece> forward = std::move(pieces_);
  const Domain& domain = curve.domain[0];
  const auto within = [&](double phi) { return domain.periodic ? phi : std::clamp(phi, domain.lo, domain.hi); };
  // Behind the start the curve is walked backwards, then turned: s to -s, the odd powers change sign.
  pieces_.clear();
  const auto walk = [&](double from, double to) {
    for (int i = 0; i < kFirstPieces && to != from; ++i)
      if (!append(from + (to - from) * i / kFirstPieces, from + (to - from) * (i + 1) / kFirstPieces, kDeepest / 2)) break;
  };
  // As far as it goes on smoothly.
  walk(start, within(start - kBeyond * way_));
  pieces_.resize(countJoined());
  std::reverse(pieces_.begin(), pieces_.end());
  for (Piece& piece : pieces_) {
    std::swap(piece.from, piece.to);
    piece.from = -piece.from, piece.to = -piece.to;
    for (int k = 1; k < kTerms; k += 2) piece.position[k] = -piece.position[k];
  }
  const size_t before = pieces_.size();
  pieces_.insert(pieces_.end(), forward.begin(), forward.end());
  if (countJoined() < pieces_.size()) pieces_.erase(pieces_.begin(), pieces_.begin() + static_cast<long>(before));
  walk(target, within(target + kBeyond * way_));
  pieces_.resize(countJoined());
}

bool ArcCurve::breakOff(double phi, std::string what) {
  if (break_.what.empty()) break_ = {phi, std::move(what)};
  return false;
}

// Adds the part between two parameters, in halves where 16 terms do not resolve it; false where halving does not help.
bool ArcCurve::append(double phi, double phiEnd, int depth) {
  const Curve& curve = curve_;
  static const GaussRule rule = makeGaussRule(kNodes);
  static constexpr auto kPower = legendrePowers<kNodes>();
  const auto halves = [&] {
    const double middle = (phi + phiEnd) / 2;
    return depth < kDeepest ? append(phi, middle, depth + 1) && append(middle, phiEnd, depth + 1) : appendShort(phi, phiEnd);
  };
  const double half = (phiEnd - phi) / 2;
  std::vector<double> speed;
  for (const double x : rule.node) speed.push_back(norm(evaluate(curve, phi + half * (x + 1)).rPhi) * std::abs(half));
  const double fastest = *std::max_element(speed.begin(), speed.end());
  const LegendreSeries rate = projectOnLegendre(speed, rule.node, rule.weight);
  if (!(fastest > 0) || !std::isfinite(fastest) || !isResolved(rate, kResolved * fastest)) return halves();
  const LegendreSeries arc = integralOf(rate);
  const double way = along_ == Along::ArcLength ? 2 * rate[0] : std::abs(phiEnd - phi);

  std::array<std::vector<double>, 3> curvature;
  double sharpest = 0, x = -1;
  for (const double node : rule.node) {
    const double s = way * (node + 1) / 2;
    if (along_ == Along::Parameter) x = node;
    for (int pass = 0; pass < 12 && along_ == Along::ArcLength; ++pass) {
      const double step = (valueAt(arc, x) - s) / valueAt(rate, x);
      x = std::clamp(x - step, -1.0, 1.0);
      if (std::abs(step) < 1e-15) break;
    }
    const CurvePoint p = evaluate(curve, phi + half * (x + 1));
    const double square = dot(p.rPhi, p.rPhi);
    const Vec3 c = along_ == Along::Parameter ? half * half * p.rPhiPhi
                                              : (way * way / 4) * ((p.rPhiPhi - (dot(p.rPhi, p.rPhiPhi) / square) * p.rPhi) / square);
    curvature[0].push_back(c.x), curvature[1].push_back(c.y), curvature[2].push_back(c.z);
    sharpest = std::max(sharpest, norm(c));
  }
  Piece piece;
  piece.begin = phi;
  piece.from = pieces_.empty() ? 0 : pieces_.back().to;
  piece.to = piece.from + way;
  std::array<LegendreSeries, 3> series;
  for (size_t k = 0; k < 3; ++k) {
    series[k] = projectOnLegendre(curvature[k], rule.node, rule.weight);
    if (!isResolved(series[k], kResolved * sharpest + kNoise * 2 * rate[0])) return halves();
  }
  for (int n = 0; n < kNodes; ++n)
    for (int j = 0; j <= n; ++j) piece.position[j + 2] += Vec3{series[0][n], series[1][n], series[2][n]} * kPower[n][j];
  for (int j = 2; j < kTerms; ++j) piece.position[j] = piece.position[j] / (j * (j - 1));
  // Tangent and place at the beginning, x = -1; where that is a kink, in the middle.
  for (const double at : {-1.0, 0.0}) {
    const CurvePoint p = evaluate(curve, phi + half * (at + 1));
    const double x0 = along_ == Along::Parameter || at < 0 ? at : 2 * valueAt(arc, at) / way - 1;
    const Vec3 tangent = along_ == Along::Parameter ? half * p.rPhi : (half > 0 ? 1 : -1) * way / 2 / norm(p.rPhi) * p.rPhi;
    if (!isFinite(tangent) || !std::isfinite(sharpest)) continue;
    piece.position[0] = p.r, piece.position[1] = tangent;
    double power = x0;
    for (int j = 2; j < kTerms; ++j, power *= x0) piece.position[1] -= j * piece.position[j] * power;
    power = x0;
    for (int j = 1; j < kTerms; ++j, power *= x0) piece.position[0] -= piece.position[j] * power;
    if (!fits(piece, phi, phiEnd, arc)) continue;
    pieces_.push_back(piece);
    return true;
  }
  return halves();
}

// Whether the piece goes through the formula's own places.
bool ArcCurve::fits(const Piece& piece, double phi, double phiEnd, const LegendreSeries& arc) const {
  const double way = piece.to - piece.from, length = valueAt(arc, 1.0), share = std::abs((phiEnd - phi) / way_);
  const int checks = 4 + static_cast<int>(std::min(1.0, share) * kChecks);
  for (int i = 0; i <= checks; ++i) {
    const double x = i == checks ? 1 : 2.0 * i / checks - 1, at = along_ == Along::Parameter ? x : 2 * valueAt(arc, x) / way - 1;
    const Vec3 r = evaluate(curve_, phi + (phiEnd - phi) * (x + 1) / 2).r;
    Vec3 sum;
    for (int j = kTerms; j-- > 0;) sum = at * sum + piece.position[j];
    if (!(norm(r - sum) <= kFits * length + kPlace * norm(r))) return false;
  }
  return true;
}

// A part that cannot be halved further: without direction of its own, so that only a change of pace passes there.
bool ArcCurve::appendShort(double phi, double phiEnd) {
  const double middle = (phi + phiEnd) / 2;
  const CurvePoint begin = evaluate(curve_, phi), end = evaluate(curve_, phiEnd);
  const Vec3 chord = end.r - begin.r;
  const double speed = std::max(norm(begin.rPhi), norm(end.rPhi)), length = norm(chord);
  if (!isFinite(chord) || !std::isfinite(speed)) return breakOff(middle, "no value, or no direction,");
  if (!(speed > fastest_ / kCusp)) return breakOff(middle, kCuspWords);
  if (length > 4 * speed * std::abs(phiEnd - phi) + kPlace * norm(begin.r))
    return breakOff(middle, fmt::format("a jump of {:.3g} m", length));
  if (along_ == Along::Parameter) return breakOff(middle, "a kink, a cusp or a change of pace");
  Piece piece;
  piece.begin = phi;
  piece.isShort = true;
  piece.from = pieces_.empty() ? 0 : pieces_.back().to;
  piece.to = piece.from + length;
  piece.position[1] = chord / 2;
  piece.position[0] = begin.r + piece.position[1];
  pieces_.push_back(piece);
  return true;
}

template <int Order>
std::array<Vec3, Order + 1> ArcCurve::expand(const Piece& piece, double x) {
  std::array<Vec3, Order + 1> d{};
  for (int j = kTerms; j-- > 0;) {
    for (int m = Order; m > 0; --m) d[m] = x * d[m] + d[m - 1];
    d[0] = x * d[0] + piece.position[j];
  }
  const double scale = 2 / (piece.to - piece.from);
  double factor = 1;
  for (int m = 1; m <= Order; ++m) d[m] *= factor *= m * scale;
  return d;
}

// Whether place, tangent and curvature go over from one piece to the next; in the parameter, the pace too.
bool ArcCurve::joins(const Piece& before, const Piece& after) {
  const auto a = expand<2>(before, 1), b = expand<2>(after, -1);
  const double pace = std::min(norm(a[1]), norm(b[1])), shorter = std::min(before.to - before.from, after.to - after.from);
  const double between = 1.5 * (after.from - before.to), longer = std::max(before.to - before.from, after.to - after.from);
  if (!(norm(a[0] - b[0]) <= pace * (between + 1e-6 * longer) + kPlace * norm(b[0])))
    return breakOff(after.begin, fmt::format("a jump of {:.3g} m", norm(a[0] - b[0])));
  if (!(norm(a[1] - b[1]) <= kTurns * pace)) {
    const double degrees = degreesBetween(a[1], b[1]);
    return breakOff(after.begin, degrees > 179.9  ? kCuspWords
                                 : degrees > 1e-4 ? fmt::format("a kink (its direction turns by {:.3g} degrees)", degrees)
                                                  : "a change of pace");
  }
  const double rounding = pace * (1e-7 / length_ + 1e-12 / shorter);
  if (!(norm(a[2] - b[2]) <= 1e-3 * std::max(norm(a[2]), norm(b[2])) + rounding)) return breakOff(after.begin, "a step of its curvature");
  return true;
}

// How many pieces go on from each other. Short ones have no direction: those on either side of them must join.
size_t ArcCurve::countJoined() {
  const Piece* before = nullptr;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    if (pieces_[i].isShort) continue;
    if (before != nullptr && !joins(*before, pieces_[i])) return i;
    before = &pieces_[i];
  }
  return pieces_.size();
}

const ArcCurve::Piece& ArcCurve::pieceAt(double s) const {
  const auto next =
      std::upper_bound(pieces_.begin(), pieces_.end(), s, [](double value, const Piece& piece) { return value < piece.from; });
  return next == pieces_.begin() ? pieces_.front() : *(next - 1);
}

ArcCurve ArcCurve::magnified(double part) const {
  ArcCurve magnified = *this;
  magnified.part_ = part;
  return magnified;
}

template <int Order>
std::array<Vec3, Order + 1> ArcCurve::expand(double s) const {
  if (part_ == 1) return expandWhole<Order>(s);
  if (part_ == 0) {
    const Vec3 tangent = expandWhole<Order>(0)[1];
    return {s * tangent, tangent};
  }
  auto d = expandWhole<Order>(part_ * s);
  d[0] = (d[0] - expandWhole<Order>(0)[0]) / part_;
  double factor = 1;
  for (int m = 2; m <= Order; ++m) d[m] *= factor *= part_;
  return d;
}

template <int Order>
std::array<Vec3, Order + 1> ArcCurve::expandWhole(double s) const {
  const double inside = std::clamp(s, lowest(), highest());
  const Piece& piece = pieceAt(inside);
  auto d = expand<Order>(piece, (inside - piece.from) * (2 / (piece.to - piece.from)) - 1);
  if (s != inside) {  // straight on
    d[0] += (s - inside) * d[1];
    for (int m = 2; m <= Order; ++m) d[m] = {};
  }
  return d;
}

template std::array<Vec3, 3> ArcCurve::expand<2>(double) const;
template std::array<Vec3, 4> ArcCurve::expand<3>(double) const;
template std::array<Vec3, 6> ArcCurve::expand<5>(double) const;

}  // namespace reachlab::constraints
