#include "sim/subjects/plans/sampled_plan.h"

#include <algorithm>
#include <cmath>

#include "base/math/lanes.h"
#include "base/ticks.h"

namespace reachlab::subjects {
namespace {

constexpr std::size_t kNodes = 6;

}  // namespace

SampledPlan::SampledPlan(ReachPlan plan) : plan_(std::move(plan)) {
  const auto cells = static_cast<std::size_t>(std::ceil(plan_.duration / kTickSeconds));
  if (cells < kNodes) return;
  step_ = plan_.duration / static_cast<double>(cells);
  places_.reserve(4 * (cells + 1));
  for (std::size_t i = 0; i <= cells; ++i) {
    const Vec3 place = plan_.handAt(std::min(static_cast<double>(i) * step_, plan_.duration));
    places_.insert(places_.end(), {place.x, place.y, place.z, 0});
  }
  for (std::size_t i = 0; i < cells; ++i) {
    const double middle = (static_cast<double>(i) + 0.5) * step_;
    if (norm(interpolate(middle) - plan_.handAt(middle)) <= kWithin) continue;
    places_.clear();
    return;
  }
}

// Lagrange's form on equally spaced nodes, x from the third of the six.
Vec3 SampledPlan::interpolate(double time) const noexcept {
  const double at = time / step_;
  const auto last = places_.size() / 4 - kNodes;
  const auto cell = static_cast<std::size_t>(std::max(at, 2.0)) - 2;
  const std::size_t first = std::min(cell, last);
  const double x = at - static_cast<double>(first);
  const double a = x, b = x - 1, c = x - 2, d = x - 3, e = x - 4, f = x - 5;
  const double ab = a * b, cd = c * d, ef = e * f;
  const Lanes<4> w = Lanes<4>{b * cd * ef, a * cd * ef, ab * d * ef, ab * c * ef} / Lanes<4>{-120, 24, -12, 12};
  const Lanes<2> v = Lanes<2>{ab * cd * f, ab * cd * e} / Lanes<2>{-24, 120};
  const auto p = [&](std::size_t i) { return loadLanes<Lanes<4>>(&places_[4 * (first + i)]); };
  const Lanes<4> place = w[0] * p(0) + w[1] * p(1) + w[2] * p(2) + w[3] * p(3) + v[0] * p(4) + v[1] * p(5);
  return {place[0], place[1], place[2]};
}

}  // namespace reachlab::subjects
