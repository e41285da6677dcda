#pragma once

namespace reachlab {

/// The minimum-jerk law from rest at 0 to rest at 1 over 0 <= x <= 1 (Flash and Hogan 1985) with its first two derivatives by x, in the
/// arithmetic of T. It is a polynomial and is not held beyond its ends. Any thread.
template <class T>
constexpr T minimumJerk(const T& x) {
  return x * x * x * (10 + x * (6 * x - 15));
}
template <class T>
constexpr T minimumJerkRate(const T& x) {
  return 30 * x * x * (1 - x) * (1 - x);
}
template <class T>
constexpr T minimumJerkAcceleration(const T& x) {
  return 60 * x * (1 - x) * (1 - 2 * x);
}

/// The law of a whole movement: 0 before x = 0, 1 after x = 1. Near the end 1 - s(1 - x) keeps the digits.
struct MinimumJerk {
  double value = 0, rate = 0;
};
constexpr MinimumJerk heldMinimumJerk(double x) noexcept {
  if (x <= 0) return {0, 0};
  if (x >= 1) return {1, 0};
  return {x < 0.5 ? minimumJerk(x) : 1 - minimumJerk(1 - x), minimumJerkRate(x)};
}

}  // namespace reachlab
