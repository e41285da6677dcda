#include "devices/replay/natural_spline.h"

#include <algorithm>

namespace reachlab::devices {

NaturalSpline::NaturalSpline(std::vector<double> time, std::vector<Vec3> value)
    : time_(std::move(time)), value_(std::move(value)), bend_(value_.size()) {
  // h0 M0 + 2 (h0 + h1) M1 + h1 M2 = 6 (d1 - d0) at each inner knot, by forward elimination and back substitution.
  const std::size_t n = time_.size();
  std::vector<double> factor(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double h0 = time_[i] - time_[i - 1], h1 = time_[i + 1] - time_[i];
    const Vec3 right = 6 * ((value_[i + 1] - value_[i]) / h1 - (value_[i] - value_[i - 1]) / h0);
    const double pivot = 2 * (h0 + h1) - h0 * factor[i - 1];
    factor[i] = h1 / pivot;
    bend_[i] = (right - h0 * bend_[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) bend_[i] -= factor[i] * bend_[i + 1];
}

Vec3 NaturalSpline::at(double t) const {
  const auto above = std::upper_bound(time_.begin() + 1, time_.end() - 1, t);
  const auto i = static_cast<std::size_t>(above - time_.begin()) - 1;
  const double h = time_[i + 1] - time_[i], b = (t - time_[i]) / h, a = 1 - b;
  return a * value_[i] + b * value_[i + 1] + h * h / 6 * ((a * a * a - a) * bend_[i] + (b * b * b - b) * bend_[i + 1]);
}

}  // namespace reachlab::devices
