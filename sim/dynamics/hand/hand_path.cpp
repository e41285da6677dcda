#include "sim/dynamics/hand/hand_path.h"

#include <algorithm>

namespace reachlab::dynamics {
namespace {

/// Coefficients in s of the polynomial through p[0] at s = 1, p[1] at 0, p[2] at -1, p[3] at -2 (the first `count` of them).
void interpolate(const std::array<Vec3, 4>& p, int count, HandSegment::Coefficients& c) noexcept {
  if (count == 1) {
    c[0] = p[0];
    return;
  }
  // Newton's form from s = 0: differences keep the digits of a hand that hardly moves.
  const Vec3 first = p[0] - p[1];
  const Vec3 second = count > 2 ? 0.5 * (p[0] - 2.0 * p[1] + p[2]) : Vec3{};
  const Vec3 third = count > 3 ? (p[0] - 3.0 * p[1] + 3.0 * p[2] - p[3]) / 6 : Vec3{};
  // p(s) = p1 + first s + second s (s-1) + third s (s-1) (s+1)
  c[0] = p[1];
  c[1] = first - second - third;
  c[2] = second;
  c[3] = third;
}

}  // namespace

bool HandPath::push(const HandSample& sample) noexcept {
  if (!sample.valid || !isFinite(sample.position) || !isFinite(sample.velocity)) {
    count_ = std::min(count_, 1);
    return false;
  }
  const bool jumped = count_ > 0 && norm(sample.position - position_[0]) > jump_;
  if (broken_) count_ = std::min(count_, 1);  // nothing from before the jump
  for (std::size_t i = 3; i > 0; --i) {
    position_[i] = position_[i - 1];
    velocity_[i] = velocity_[i - 1];
  }
  position_[0] = sample.position;
  velocity_[0] = sample.velocity;
  count_ = std::min({count_ + 1, most_, jumped ? 2 : 4});
  broken_ = jumped;
  return !jumped;
}

HandSegment HandPath::segment(bool withVelocity) const noexcept {
  HandSegment segment;
  if (count_ == 0) return segment;
  segment.degree = count_ - 1;
  interpolate(position_, count_, segment.position);
  if (withVelocity) interpolate(velocity_, count_, segment.velocity);
  return segment;
}

}  // namespace reachlab::dynamics
