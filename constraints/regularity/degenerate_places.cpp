#include <algorithm>
#include <cmath>
#include <functional>

#include "constraints/constraint.h"
#include "constraints/regularity/analysis.h"

namespace reachlab::constraints {
namespace {

constexpr int kLines = 256;     // parameter lines looked at
constexpr int kAlong = 33;      // places along each
constexpr double kZero = 1e-9;  // of the largest value seen; rounding leaves about 1e-16, a search about 1e-12

double area(const SurfacePoint& p) { return norm(cross(p.rU, p.rV)); }

// Golden-section search; the functions here are V-shaped at their zeros, so it comes as near as rounding allows.
double minimise(const std::function<double(double)>& f, double lo, double hi) {
  constexpr double kGolden = 0.6180339887498949;
  double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo), fa = f(a), fb = f(b);
  for (int i = 0; i < 90; ++i) {
    if (fa < fb) {
      hi = b, b = a, fb = fa;
      fa = f(a = hi - kGolden * (hi - lo));
    } else {
      lo = a, a = b, fa = fb;
      fb = f(b = lo + kGolden * (hi - lo));
    }
  }
  return fa < fb ? a : b;
}

class PlaceFinder {
 public:
  explicit PlaceFinder(const Constraint& c) : c_(c), domain_(boundedDomain(c)) {}

  std::vector<DegeneratePlace> find() {
    for (int i = 0; i <= kAlong; ++i)
      for (int j = 0; j <= kAlong; ++j) {
        const SurfacePoint p = at(0, fraction(0, i / double{kAlong}), fraction(1, j / double{kAlong}));
        largestArea_ = std::max(largestArea_, area(p));
        largestSide_ = std::max({largestSide_, norm(p.rU), norm(p.rV)});
      }
    findLines(0);
    findLines(1);
    findPoints();
    return places_;
  }

 private:
  double fraction(int k, double t) const { return t == 1 ? domain_[k].hi : domain_[k].lo + (domain_[k].hi - domain_[k].lo) * t; }
  // The point with parameter `fixed` equal to a, the other to b.
  SurfacePoint at(int fixed, double a, double b) const { return fixed == 0 ? evaluate(c_.surface, a, b) : evaluate(c_.surface, b, a); }

  double largestAlong(int fixed, double a, const std::function<double(const SurfacePoint&)>& f) const {
    double largest = 0;
    for (int j = 0; j < kAlong; ++j) largest = std::max(largest, f(at(fixed, a, fraction(1 - fixed, (j + 0.381966) / kAlong))));
    return largest;
  }

  void findLines(int fixed) {
    const auto value = [&](double a) { return largestAlong(fixed, a, area); };
    const int n = kLines;
    std::vector<double> w(n + 1);
    for (int i = 0; i <= n; ++i) w[i] = value(fraction(fixed, i / double{kLines}));
    const int last = domain_[fixed].periodic ? n - 1 : n;
    for (int i = 0; i <= last; ++i) {
      if ((i > 0 && w[i - 1] < w[i]) || (i < n && w[i + 1] <= w[i])) continue;
      double a = fraction(fixed, i / double{kLines});
      if (w[i] > kZero * largestArea_)
        a = minimise(value, fraction(fixed, std::max(0, i - 1) / double{kLines}), fraction(fixed, std::min(n, i + 1) / double{kLines}));
      if (value(a) <= kZero * largestArea_) addLine(fixed, a);
    }
  }

  void addLine(int fixed, double a) {
    DegeneratePlace place;
    place.fixed = fixed;
    const double b = fraction(1 - fixed, 0.381966);
    (fixed == 0 ? place.u : place.v) = a;
    (fixed == 0 ? place.v : place.u) = b;
    place.r = at(fixed, a, b).r;
    const bool collapsed =
        largestAlong(fixed, a, [&](const SurfacePoint& p) { return norm(fixed == 0 ? p.rV : p.rU); }) <= 1e-7 * largestSide_;
    place.kind = !collapsed ? DegenerateKind::Edge : isSmooth(fixed, a, place.normal) ? DegenerateKind::Pole : DegenerateKind::Apex;
    places_.push_back(place);
  }

  // Do the normals around a collapsed line meet in one as it is approached?
  bool isSmooth(int fixed, double a, Vec3& normal) const {
    const double range = domain_[fixed].hi - domain_[fixed].lo;
    const double inwards = a - domain_[fixed].lo > range / 2 ? -1 : 1;
    const auto spread = [&](double distance, Vec3& mean) {
      std::vector<Vec3> normals;
      mean = {};
      for (int j = 0; j < kAlong; ++j) {
        const SurfacePoint p = at(fixed, a + inwards * distance * range, fraction(1 - fixed, (j + 0.381966) / kAlong));
        const Vec3 n = cross(p.rU, p.rV);
        normals.push_back(n / norm(n));
        mean += normals.back();
      }
      if (const double length = norm(mean); length > 0) mean = mean / length;
      double widest = 0;
      for (const Vec3& n : normals) widest = std::max(widest, norm(n - mean));
      return widest;
    };
    const double far = spread(1e-3, normal), near = spread(1e-4, normal);
    return near < 0.3 * far || near < 1e-9;
  }

  bool onLine(double u, double v) const {
    for (const DegeneratePlace& p : places_) {
      if (p.fixed < 0) continue;
      const double range = domain_[p.fixed].hi - domain_[p.fixed].lo;
      double distance = std::abs((p.fixed == 0 ? u - p.u : v - p.v));
      if (domain_[p.fixed].periodic) distance = std::min(distance, std::abs(range - distance));
      if (distance < 2.5 * range / kLines) return true;
    }
    return false;
  }

  void findPoints() {
    constexpr int n = 96;
    std::vector<double> w((n + 1) * (n + 1));
    const auto index = [](int i, int j) { return i * (n + 1) + j; };
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) w[index(i, j)] = area(evaluate(c_.surface, fraction(0, i / double{n}), fraction(1, j / double{n})));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j) {
        if (places_.size() >= kMaxDegeneratePlaces || w[index(i, j)] > 0.2 * largestArea_) continue;
        bool lowest = true;
        for (int di = -1; di <= 1; ++di)
          for (int dj = -1; dj <= 1; ++dj) {
            const int ni = i + di, nj = j + dj;
            if (ni >= 0 && nj >= 0 && ni <= n && nj <= n && w[index(ni, nj)] < w[index(i, j)]) lowest = false;
          }
        if (lowest) addPoint(fraction(0, i / double{n}), fraction(1, j / double{n}), 1.0 / n);
      }
  }

  void addPoint(double u, double v, double step) {
    const double uRange = domain_[0].hi - domain_[0].lo, vRange = domain_[1].hi - domain_[1].lo;
    double best = area(evaluate(c_.surface, u, v));
    // Pattern search with a step that halves when no neighbour is lower.
    for (int rounds = 0; rounds < 400 && step > 1e-15 && best > 0; ++rounds) {
      double nextU = u, nextV = v, nextBest = best;
      for (int di = -1; di <= 1; ++di)
        for (int dj = -1; dj <= 1; ++dj) {
          const double tryU = std::clamp(u + di * step * uRange, domain_[0].lo, domain_[0].hi);
          const double tryV = std::clamp(v + dj * step * vRange, domain_[1].lo, domain_[1].hi);
          const double value = area(evaluate(c_.surface, tryU, tryV));
          if (value < nextBest) nextU = tryU, nextV = tryV, nextBest = value;
        }
      if (nextBest < best) u = nextU, v = nextV, best = nextBest;
      else step /= 2;
    }
    if (!(best <= kZero * largestArea_) || onLine(u, v)) return;
    DegeneratePlace place;
    place.kind = DegenerateKind::Pinch;
    place.u = u;
    place.v = v;
    place.r = evaluate(c_.surface, u, v).r;
    for (const DegeneratePlace& p : places_)
      if (p.kind == DegenerateKind::Pinch && std::abs(p.u - u) < 1e-6 * uRange && std::abs(p.v - v) < 1e-6 * vRange) return;
    places_.push_back(place);
  }

  const Constraint& c_;
  std::array<Domain, 2> domain_;
  double largestArea_ = 0, largestSide_ = 0;
  std::vector<DegeneratePlace> places_;
};

}  // namespace

std::vector<DegeneratePlace> findDegeneratePlaces(const Constraint& c) {
  if (c.kind != ConstraintKind::Surface) return {};
  return PlaceFinder(c).find();
}

}  // namespace reachlab::constraints
