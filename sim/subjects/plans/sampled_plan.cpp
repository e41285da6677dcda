#include "sim/subjects/plans/sampled_plan.h"

#include <algorithm>
#include <cmath>

#include "base/ticks.h"

namespace reachlab::subjects {
namespace {

constexpr std::size_t kPoints = 6;

}  // namespace

SampledPlan::SampledPlan(ReachPlan plan) : plan_(std::move(plan)) {
  const auto cells = static_cast<std::size_t>(std::ceil(plan_.duration / kTickSeconds));
  if (cells < kPoints) return;
  step_ = plan_.duration / static_cast<double>(cells);
  places_.reserve(cells + 1);
  for (std::size_t i = 0; i <= cells; ++i) places_.push_back(plan_.handAt(std::min(static_cast<double>(i) * step_, plan_.duration)));
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
  const auto last = places_.size() - kPoints;
  const auto cell = static_cast<std::size_t>(std::max(at, 2.0)) - 2;
  const std::size_t first = std::min(cell, last);
  const double x = at - static_cast<double>(first);
  const double a = x, b = x - 1, c = x - 2, d = x - 3, e = x - 4, f = x - 5;
  const double ab = a * b, cd = c * d, ef = e * f;
  const Vec3* p = places_.data() + first;
  return (b * cd * ef / -120) * p[0] + (a * cd * ef / 24) * p[1] + (ab * d * ef / -12) * p[2] + (ab * c * ef / 12) * p[3] +
         (ab * cd * f / -24) * p[4] + (ab * cd * e / 120) * p[5];
}

}  // namespace reachlab::subjects
