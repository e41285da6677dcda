#include "gui/scene/place_under.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>

#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"

namespace reachlab::gui::scene {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kSameSpot = 0.5;  // pixels: places drawn closer than this are one over the other
constexpr double kShown = 0.05;    // pixels that rounding may move a place

// Where a point of the constraint is drawn, beside the pixel.
struct Seen {
  std::vector<double> q;
  double right = kNever, down = kNever, depth = kNever;  // pixels, pixels, metres from the viewer
  double apart() const { return std::hypot(right, down); }
};

class Looker {
 public:
  Looker(const PixelSeen& pixel, const constraints::Constraint& constraint, const std::array<constraints::Domain, 2>& drawn)
      : pixel_(pixel), constraint_(constraint), drawn_(drawn), forward_(axesOf(pixel.camera).forward) {}

  Seen at(std::vector<double> q) const {
    Seen seen;
    const Vec3 r = placeOn(constraint_, q);
    seen.q = std::move(q);
    const double depth = dot(r - pixel_.camera.position, forward_);
    if (!isFinite(r) || (depth <= 0 && !pixel_.camera.parallel)) return seen;
    const auto [x, y] = pixelOf(pixel_.camera, r, pixel_.width, pixel_.height);
    seen.right = x - pixel_.x;
    seen.down = y - pixel_.y;
    seen.depth = depth;
    return seen;
  }
  std::vector<double> kept(std::vector<double> q) const {
    for (std::size_t i = 0; i < std::min(q.size(), drawn_.size()); ++i) q[i] = std::clamp(q[i], drawn_[i].lo, drawn_[i].hi);
    return q;
  }
  double range(std::size_t i) const { return drawn_[i].hi - drawn_[i].lo; }
  double low(std::size_t i) const { return drawn_[i].lo; }

 private:
  const PixelSeen& pixel_;
  const constraints::Constraint& constraint_;
  std::array<constraints::Domain, 2> drawn_;
  Vec3 forward_;
};

// Of those that are drawn as near to the pixel as the nearest, the one in front.
std::optional<Seen> frontOf(const std::vector<Seen>& found) {
  double least = kNever;
  for (const Seen& one : found) least = std::min(least, one.apart());
  std::optional<Seen> front;
  for (const Seen& one : found)
    if (one.apart() <= least + kSameSpot && (!front || one.depth < front->depth)) front = one;
  return std::isfinite(least) ? front : std::nullopt;
}

// A period more or less is the same point.
double wrapped(double off, const constraints::Domain& domain) { return domain.periodic ? std::remainder(off, domain.hi - domain.lo) : off; }

// Where a shape runs over one point more than once (a Moebius strip has each point twice), the parameters nearest to those before.
Seen nearestTo(std::span<const double> about, const constraints::Constraint& constraint, const std::array<constraints::Domain, 2>& drawn,
               const std::vector<Seen>& found, const Seen& front, double sameSpot) {
  const auto away = [&](const Seen& one) {
    double sum = 0;
    for (std::size_t i = 0; i < std::min(one.q.size(), about.size()); ++i)
      sum += std::abs(wrapped(one.q[i] - about[i], constraint.domain[i])) / (drawn[i].hi - drawn[i].lo);
    return sum;
  };
  const Vec3 place = placeOn(constraint, front.q);
  const Seen* best = &front;
  for (const Seen& one : found)
    if (norm(placeOn(constraint, one.q) - place) <= sameSpot && away(one) < away(*best)) best = &one;
  return *best;
}

// The pixel's distance from the drawn line between two points.
double apartFromLine(const Seen& a, const Seen& b) {
  if (!std::isfinite(a.apart()) || !std::isfinite(b.apart())) return std::min(a.apart(), b.apart());
  const double right = b.right - a.right, down = b.down - a.down, length2 = right * right + down * down;
  const double t = length2 > 0 ? std::clamp(-(a.right * right + a.down * down) / length2, 0.0, 1.0) : 0;
  return std::hypot(a.right + t * right, a.down + t * down);
}

Seen nearestBetween(const Looker& look, double low, double high) {
  const auto apart = [&](double q) { return look.at({q}).apart(); };
  Seen best = look.at({boost::math::tools::brent_find_minima(apart, low, high, 40).first});
  for (const double end : {low, high})
    if (Seen seen = look.at({end}); seen.apart() < best.apart()) best = std::move(seen);
  return best;
}

std::vector<Seen> onCurve(const Looker& look) {
  constexpr std::size_t kParts = 3000;
  constexpr double kFar = 4;  // pixels beyond the nearest that a piece of so many may still hide
  std::vector<Seen> knots;
  for (std::size_t i = 0; i <= kParts; ++i)
    knots.push_back(look.at({look.low(0) + look.range(0) * static_cast<double>(i) / static_cast<double>(kParts)}));
  std::vector<double> apart;
  for (std::size_t i = 0; i < kParts; ++i) apart.push_back(apartFromLine(knots[i], knots[i + 1]));
  const double least = *std::min_element(apart.begin(), apart.end());
  std::vector<Seen> found;
  for (std::size_t i = 0; i < kParts; ++i) {
    const bool lowest = (i == 0 || apart[i] <= apart[i - 1]) && (i + 1 == kParts || apart[i] <= apart[i + 1]);
    if (lowest && apart[i] <= least + kFar) {
      found.push_back(nearestBetween(look, knots[i == 0 ? 0 : i - 1].q[0], knots[std::min(i + 2, kParts)].q[0]));
      found.push_back(nearestBetween(look, knots[i].q[0], knots[i + 1].q[0]));
    }
  }
  return found;
}

// From a guess to where the surface is drawn at the pixel, or as near to it as the surface comes: Levenberg's and Marquardt's steps, held
// inside the drawn range.
Seen approach(const Looker& look, Seen from) {
  double damping = 1e-3;
  for (int pass = 0; pass < 60 && from.apart() > 1e-3; ++pass) {
    double right[2], down[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const double step = (from.q[i] > look.low(i) + 0.5 * look.range(i) ? -1e-6 : 1e-6) * look.range(i);
      std::vector<double> beside = from.q;
      beside[i] += step;
      const Seen other = look.at(beside);
      if (!std::isfinite(other.apart())) return from;
      right[i] = (other.right - from.right) * look.range(i) / step;
      down[i] = (other.down - from.down) * look.range(i) / step;
    }
    const double uu = right[0] * right[0] + down[0] * down[0], vv = right[1] * right[1] + down[1] * down[1],
                 uv = right[0] * right[1] + down[0] * down[1];
    const double u = -(right[0] * from.right + down[0] * from.down), v = -(right[1] * from.right + down[1] * from.down);
    bool better = false;
    for (int attempt = 0; attempt < 12 && !better; ++attempt) {
      const double more = damping * (uu + vv) + 1e-12, determinant = (uu + more) * (vv + more) - uv * uv;
      const double du = std::clamp((u * (vv + more) - v * uv) / determinant, -0.1, 0.1),
                   dv = std::clamp((v * (uu + more) - u * uv) / determinant, -0.1, 0.1);
      Seen next = look.at(look.kept({from.q[0] + du * look.range(0), from.q[1] + dv * look.range(1)}));
      better = next.apart() < from.apart();
      damping = better ? 0.2 * damping : 6 * damping;
      if (better) from = std::move(next);
    }
    if (!better) break;
  }
  return from;
}

// Outside the contour the way to the nearest point bends along it, and along the edges of the domain: from neighbour to neighbour.
Seen creep(const Looker& look, Seen from, double part) {
  constexpr int kMostSteps = 4000;
  int steps = 0;
  for (; part > 1e-7 && steps < kMostSteps; part *= 0.5)
    for (bool better = true; better && steps < kMostSteps;) {
      better = false;
      for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}) {
        Seen next = look.at(look.kept({from.q[0] + du * part * look.range(0), from.q[1] + dv * part * look.range(1)}));
        ++steps;
        if (next.apart() < from.apart()) from = std::move(next), better = true;
      }
    }
  return from;
}

std::vector<Seen> onSurface(const Looker& look) {
  constexpr std::size_t kParts = 120;
  constexpr double kAround = 3;  // pixels about a piece: it bulges between its corners
  std::vector<Seen> knots;
  const auto value = [&](std::size_t k, double i) { return look.low(k) + look.range(k) * i / static_cast<double>(kParts); };
  for (std::size_t i = 0; i <= kParts; ++i)
    for (std::size_t j = 0; j <= kParts; ++j)
      knots.push_back(look.at({value(0, static_cast<double>(i)), value(1, static_cast<double>(j))}));
  std::vector<Seen> found;
  for (std::size_t i = 0; i < kParts; ++i)
    for (std::size_t j = 0; j < kParts; ++j) {
      double left = kNever, right = -kNever, above = kNever, below = -kNever;
      for (const std::size_t k :
           {i * (kParts + 1) + j, i * (kParts + 1) + j + 1, (i + 1) * (kParts + 1) + j, (i + 1) * (kParts + 1) + j + 1}) {
        if (!std::isfinite(knots[k].apart())) continue;
        left = std::min(left, knots[k].right), right = std::max(right, knots[k].right);
        above = std::min(above, knots[k].down), below = std::max(below, knots[k].down);
      }
      const double around = kAround + 0.25 * std::max(right - left, below - above);
      if (!(left <= around && right >= -around && above <= around && below >= -around)) continue;
      Seen middle = look.at({value(0, static_cast<double>(i) + 0.5), value(1, static_cast<double>(j) + 0.5)});
      if (std::isfinite(middle.apart())) found.push_back(approach(look, std::move(middle)));
    }
  if (const auto front = frontOf(found); front && front->apart() < kSameSpot) return found;
  const auto nearest = std::min_element(knots.begin(), knots.end(), [](const Seen& a, const Seen& b) { return a.apart() < b.apart(); });
  found.push_back(creep(look, *nearest, 1.0 / kParts));
  return found;
}

// The fewest digits that do not move what is seen.
std::vector<double> shortened(const Looker& look, const PixelSeen& pixel, const constraints::Constraint& constraint,
                              const std::vector<double>& exact) {
  const Vec3 place = placeOn(constraint, exact);
  const double enough = kShown * metresPerPixel(pixel.camera, place, pixel.height);
  for (int digits = 1; digits < 16; ++digits) {
    std::vector<double> q = exact;
    const double scale = std::pow(10.0, digits);
    for (double& one : q) one = std::round(one * scale) / scale;
    if (q == look.kept(q) && norm(placeOn(constraint, q) - place) <= enough) return q;
  }
  return exact;
}

}  // namespace

std::optional<std::vector<double>> placeUnder(const PixelSeen& pixel, const constraints::Constraint& constraint,
                                              const std::array<constraints::Domain, 2>& drawn, std::span<const double> about) {
  if (constraint.kind == constraints::ConstraintKind::Free) {
    if (about.size() != 3) return std::nullopt;
    const Vec3 r = pointUnder(pixel.camera, {about[0], about[1], about[2]}, pixel.x, pixel.y, pixel.width, pixel.height);
    return shortened(Looker(pixel, constraint, {}), pixel, constraint, {r.x, r.y, r.z});
  }
  const Looker look(pixel, constraint, drawn);
  const std::vector<Seen> found = constraint.kind == constraints::ConstraintKind::Curve ? onCurve(look) : onSurface(look);
  const auto front = frontOf(found);
  if (!front) return std::nullopt;
  const double sameSpot = 2 * kShown * metresPerPixel(pixel.camera, placeOn(constraint, front->q), pixel.height);
  std::vector<double> q = shortened(look, pixel, constraint, nearestTo(about, constraint, drawn, found, *front, sameSpot).q);
  for (std::size_t i = 0; i < std::min(q.size(), about.size()); ++i)
    if (constraint.domain[i].periodic) q[i] = about[i] + wrapped(q[i] - about[i], constraint.domain[i]);
  return q;
}

}  // namespace reachlab::gui::scene
