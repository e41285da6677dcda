#include "sim/predict/arc_curve.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/predict/gauss_legendre.h"
#include "sim/predict/legendre.h"

namespace reachlab::predict {
namespace {

constexpr int kFirstPieces = 6;      // of the way
constexpr int kDeepest = 24;         // halvings of a piece; what is still not smooth then is a cusp
constexpr double kBeyond = 0.5;      // of the way, before the start and behind the target
constexpr double kResolved = 2e-13;  // the last two terms of a piece, of its largest
constexpr double kNoise = 1e-14;     // the same, of the piece's length, for what is nearly straight
constexpr int kProbes = 400;         // for places where the curve is run slowly
constexpr double kCusp = 1e6;        // fastest to slowest run from which it stands still
constexpr const char* kNoWay = "the curve has a cusp, or stands still, between start and target: no smooth motion passes it";

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

double coordinate(const Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

}  // namespace

ArcCurve::ArcCurve(const constraints::Constraint& curve, double start, double target, Along along) : along_(along) {
  const double way = target - start;
  double slowest = INFINITY, fastest = 0;
  for (int i = 0; i <= kProbes; ++i) {
    const double speed = norm(constraints::evaluate(curve.curve, start + way * i / kProbes).rPhi);
    slowest = std::min(slowest, speed), fastest = std::max(fastest, speed);
  }
  unevenness_ = fastest / slowest;
  if (!(unevenness_ < kCusp)) throw RefusedError(kNoWay);
  for (int i = 0; i < kFirstPieces; ++i)
    if (!append(curve.curve, start + way * i / kFirstPieces, start + way * (i + 1) / kFirstPieces, 0)) throw RefusedError(kNoWay);
  length_ = pieces_.back().to;
  std::vector<Piece> forward = std::move(pieces_);
  const constraints::Domain& domain = curve.domain[0];
  const auto within = [&](double phi) { return domain.periodic ? phi : std::clamp(phi, domain.lo, domain.hi); };
  // Behind the start the curve is walked backwards, then turned: s to -s, the odd powers change sign.
  pieces_.clear();
  const auto walk = [&](double from, double to) {
    for (int i = 0; i < kFirstPieces && to != from; ++i)
      if (!append(curve.curve, from + (to - from) * i / kFirstPieces, from + (to - from) * (i + 1) / kFirstPieces, kDeepest / 2)) break;
  };
  walk(start, within(start - kBeyond * way));
  std::reverse(pieces_.begin(), pieces_.end());
  for (Piece& piece : pieces_) {
    std::swap(piece.from, piece.to);
    piece.from = -piece.from, piece.to = -piece.to;
    for (int k = 1; k < kTerms; k += 2)
      for (double& c : piece.position[static_cast<size_t>(k)]) c = -c;
  }
  pieces_.insert(pieces_.end(), forward.begin(), forward.end());
  walk(target, within(target + kBeyond * way));
}

// Adds the part between two parameters, in halves where 16 terms do not resolve it; false where halving does not help.
bool ArcCurve::append(const constraints::Curve& curve, double phi, double phiEnd, int depth) {
  static const GaussRule<double> rule = makeGaussRule<double>(kNodes);
  static constexpr auto kPower = legendrePowers<kNodes>();
  const auto halves = [&] {
    const double middle = (phi + phiEnd) / 2;
    return depth < kDeepest && append(curve, phi, middle, depth + 1) && append(curve, middle, phiEnd, depth + 1);
  };
  const double half = (phiEnd - phi) / 2;
  std::vector<double> speed;
  for (const double x : rule.node) speed.push_back(norm(constraints::evaluate(curve, phi + half * (x + 1)).rPhi) * std::abs(half));
  const double fastest = *std::max_element(speed.begin(), speed.end());
  const LegendreSeries rate = projectOnLegendre(speed, rule.node, rule.weight);
  if (!(fastest > 0) || !std::isfinite(fastest) || !isResolved(rate, kResolved * fastest)) return halves();
  const LegendreSeries arc = integrate(rate);
  const double way = along_ == Along::ArcLength ? 2 * rate[0] : std::abs(phiEnd - phi);

  std::array<std::vector<double>, 3> bend;
  double sharpest = 0, x = -1;
  for (const double node : rule.node) {
    const double s = way * (node + 1) / 2;
    if (along_ == Along::Parameter) x = node;
    for (int pass = 0; pass < 12 && along_ == Along::ArcLength; ++pass) {
      const double step = (evaluate(arc, x) - s) / evaluate(rate, x);
      x = std::clamp(x - step, -1.0, 1.0);
      if (std::abs(step) < 1e-15) break;
    }
    const constraints::CurvePoint p = constraints::evaluate(curve, phi + half * (x + 1));
    const double square = dot(p.rPhi, p.rPhi);
    const Vec3 c = along_ == Along::Parameter ? half * half * p.rPhiPhi
                                              : (way * way / 4) * ((p.rPhiPhi - (dot(p.rPhi, p.rPhiPhi) / square) * p.rPhi) / square);
    for (int k = 0; k < 3; ++k) bend[static_cast<size_t>(k)].push_back(coordinate(c, k));
    sharpest = std::max(sharpest, norm(c));
  }
  const constraints::CurvePoint begin = constraints::evaluate(curve, phi);
  const Vec3 tangent = along_ == Along::Parameter ? half * begin.rPhi : (half > 0 ? 1 : -1) * way / 2 / norm(begin.rPhi) * begin.rPhi;
  if (!isFinite(tangent) || !std::isfinite(sharpest)) return halves();
  Piece piece;
  piece.from = pieces_.empty() ? 0 : pieces_.back().to;
  piece.to = piece.from + way;
  for (size_t k = 0; k < 3; ++k) {
    const LegendreSeries series = projectOnLegendre(bend[k], rule.node, rule.weight);
    if (!isResolved(series, kResolved * sharpest + kNoise * 2 * rate[0])) return halves();
    for (size_t n = 0; n < kNodes; ++n)
      for (size_t j = 0; j <= n; ++j) piece.position[j + 2][k] += series[n] * kPower[n][j];
    for (size_t j = 2; j < kTerms; ++j) piece.position[j][k] /= static_cast<double>(j * (j - 1));
    // Tangent and place at the beginning, x = -1.
    double slope = coordinate(tangent, static_cast<int>(k)), place = coordinate(begin.r, static_cast<int>(k));
    for (size_t j = 2; j < kTerms; ++j) slope -= (j % 2 ? 1 : -1) * static_cast<double>(j) * piece.position[j][k];
    piece.position[1][k] = slope;
    for (size_t j = 1; j < kTerms; ++j) place -= (j % 2 ? -1 : 1) * piece.position[j][k];
    piece.position[0][k] = place;
  }
  pieces_.push_back(piece);
  return true;
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
  const double scale = 2 / (piece.to - piece.from), x = (inside - piece.from) * scale - 1;
  std::array<Vec3, Order + 1> d{};
  for (size_t j = kTerms; j-- > 0;) {
    for (int m = Order; m > 0; --m) d[m] = x * d[m] + d[m - 1];
    d[0] = x * d[0] + Vec3{piece.position[j][0], piece.position[j][1], piece.position[j][2]};
  }
  double factor = 1;
  for (int m = 1; m <= Order; ++m) d[m] *= factor *= m * scale;
  if (s != inside) {  // straight on
    d[0] += (s - inside) * d[1];
    for (int m = 2; m <= Order; ++m) d[m] = {};
  }
  return d;
}

template std::array<Vec3, 3> ArcCurve::expand<2>(double) const;
template std::array<Vec3, 4> ArcCurve::expand<3>(double) const;
template std::array<Vec3, 6> ArcCurve::expand<5>(double) const;

}  // namespace reachlab::predict
