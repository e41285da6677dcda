#include "base/math/cubic_spline.h"

#include <algorithm>

namespace reachlab {

CubicSpline::CubicSpline(std::vector<double> time, std::vector<Vec3> value, SplineEnds ends)
    : time_(std::move(time)), value_(std::move(value)), bend_(value_.size()) {
  const std::size_t n = time_.size();
  if (n < 3) return;
  const auto step = [&](std::size_t i) { return time_[i + 1] - time_[i]; };
  const auto slope = [&](std::size_t i) { return (value_[i + 1] - value_[i]) / step(i); };
  if (n == 3 && ends == SplineEnds::NotAKnot) {
    std::fill(bend_.begin(), bend_.end(), 2 * (slope(1) - slope(0)) / (time_[2] - time_[0]));
    return;
  }
  // h0 M0 + 2 (h0 + h1) M1 + h1 M2 = 6 (d1 - d0) at each inner point, by forward elimination and back substitution. Not-a-knot puts
  // M0 = M1 + (M1 - M2) h0/h1 into the first of them, and its mirror image into the last.
  const bool knotless = ends == SplineEnds::NotAKnot;
  const double first = step(0) / step(1), last = step(n - 2) / step(n - 3);
  std::vector<double> factor(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = step(i - 1), h1 = step(i);
    double low = h0, middle = 2 * (h0 + h1), high = h1;
    if (knotless && i == 1) middle += h0 * (1 + first), high -= h0 * first;
    if (knotless && i + 2 == n) middle += h1 * (1 + last), low -= h1 * last;
    const double pivot = middle - low * factor[i - 1];
    factor[i] = high / pivot;
    bend_[i] = (6 * (slope(i) - slope(i - 1)) - low * bend_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) bend_[i] -= factor[i] * bend_[i + 1];
  if (!knotless) return;
  bend_[0] = bend_[1] + (bend_[1] - bend_[2]) * first;
  bend_[n - 1] = bend_[n - 2] + (bend_[n - 2] - bend_[n - 3]) * last;
}

CubicSpline::Point CubicSpline::at(double t) const {
  if (time_.size() == 1 || t < time_.front()) return {value_.front(), {}};
  if (t > time_.back()) return {value_.back(), {}};
  const auto above = std::upper_bound(time_.begin() + 1, time_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - time_.begin()) - 1;
  const double h = time_[i + 1] - time_[i], b = (t - time_[i]) / h, a = 1 - b;
  return {a * value_[i] + b * value_[i + 1] + h * h / 6 * ((a * a * a - a) * bend_[i] + (b * b * b - b) * bend_[i + 1]),
          (value_[i + 1] - value_[i]) / h + h / 6 * ((3 * b * b - 1) * bend_[i + 1] - (3 * a * a - 1) * bend_[i])};
}

}  // namespace reachlab
