#include "cli/spline.h"

#include <algorithm>

namespace reachlab::cli {

Spline::Spline(std::vector<double> times, std::vector<double> values)
    : t_(std::move(times)), x_(std::move(values)), second_(t_.size(), 0.0) {
  const std::size_t n = t_.size();
  if (n < 3) return;
  const auto slope = [&](std::size_t i) { return (x_[i + 1] - x_[i]) / (t_[i + 1] - t_[i]); };
  if (n == 3) {
    std::fill(second_.begin(), second_.end(), 2 * (slope(1) - slope(0)) / (t_[2] - t_[0]));
    return;
  }
  // Tridiagonal system for the inner second derivatives; the third derivative is continuous at the second and last but one points.
  std::vector<double> low(n), middle(n), high(n), right(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t_[i] - t_[i - 1], after = t_[i + 1] - t_[i];
    low[i] = before;
    middle[i] = 2 * (before + after);
    high[i] = after;
    right[i] = 6 * (slope(i) - slope(i - 1));
  }
  const double a = t_[1] - t_[0], b = t_[2] - t_[1], y = t_[n - 2] - t_[n - 3], z = t_[n - 1] - t_[n - 2];
  middle[1] += a * (1 + a / b);
  high[1] -= a * a / b;
  middle[n - 2] += z * (1 + z / y);
  low[n - 2] -= z * z / y;
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const double factor = low[i] / middle[i - 1];
    middle[i] -= factor * high[i - 1];
    right[i] -= factor * right[i - 1];
  }
  for (std::size_t i = n - 2; i >= 1; --i) second_[i] = (right[i] - (i + 2 < n ? high[i] * second_[i + 1] : 0)) / middle[i];
  second_[0] = second_[1] + (second_[1] - second_[2]) * a / b;
  second_[n - 1] = second_[n - 2] + (second_[n - 2] - second_[n - 3]) * z / y;
}

Spline::Value Spline::at(double t) const {
  if (t_.size() == 1 || t < t_.front()) return {x_.front(), 0};
  if (t > t_.back()) return {x_.back(), 0};
  const auto behind = std::upper_bound(t_.begin(), t_.end() - 1, t);
  const std::size_t i = static_cast<std::size_t>(behind - t_.begin()) - 1;
  const double h = t_[i + 1] - t_[i], u = (t - t_[i]) / h, w = 1 - u;
  return {w * x_[i] + u * x_[i + 1] + h * h / 6 * ((w * w * w - w) * second_[i] + (u * u * u - u) * second_[i + 1]),
          (x_[i + 1] - x_[i]) / h + h / 6 * ((3 * u * u - 1) * second_[i + 1] - (3 * w * w - 1) * second_[i])};
}

}  // namespace reachlab::cli
