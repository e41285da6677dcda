#include "sim/haptics/velocity_estimator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/elementary.h"
#include "base/ticks.h"

namespace reachlab::haptics {
namespace {

constexpr double dt = kTickSeconds;

}  // namespace

VelocityEstimator::VelocityEstimator(const experiment::VelocityEstimatorSpec& spec)
    : kind_(Kind::Recursive), fromDevice_(spec.kind == "auto" || spec.kind == "device") {
  if (spec.kind == "difference") {
    kind_ = Kind::Difference;
  } else if (spec.kind == "low-pass") {  // 1/(s + 1), bilinear with its cut-off pre-warped
    const double w = elementary::tan(std::numbers::pi * spec.cutoff * dt), b0 = w / (1 + w);
    filter_ = {{b0, b0, 0}, {1, (w - 1) / (1 + w), 0}};
  } else if (spec.kind == "kalman") {
    kind_ = Kind::Kalman;
    designKalman(spec.cutoff);
  } else if (spec.kind == "adaptive-window") {
    kind_ = Kind::Window;
  } else {
    filter_ = butterworthLowPass(spec.cutoff, dt);
  }
  if (kind_ == Kind::Recursive) shape_ = {filter_.b[1] / filter_.b[0], filter_.b[2] / filter_.b[0]};
}

// The Riccati recursion to its fixed point. Measured place with density r = 1, white jerk of density q = (2 pi fc)^6.
void VelocityEstimator::designKalman(double cutoff) {
  const double omega = 2 * std::numbers::pi * cutoff, q = elementary::pow(omega, 6), r = 1 / dt;
  using Matrix = std::array<std::array<double, 3>, 3>;
  const Matrix f{{{1, dt, dt * dt / 2}, {0, 1, dt}, {0, 0, 1}}};
  const Matrix noise{{{q * elementary::pow(dt, 5) / 20, q * elementary::pow(dt, 4) / 8, q * elementary::pow(dt, 3) / 6},
                      {q * elementary::pow(dt, 4) / 8, q * elementary::pow(dt, 3) / 3, q * dt * dt / 2},
                      {q * elementary::pow(dt, 3) / 6, q * dt * dt / 2, q * dt}}};
  Matrix p{{{r, 0, 0}, {0, r * omega * omega, 0}, {0, 0, r * elementary::pow(omega, 4)}}};
  constexpr int kMost = 200'000;
  constexpr double kSettled = 1e-13;
  for (int i = 0; i < kMost; ++i) {
    Matrix half{}, ahead = noise;  // ahead = F P F^T + Q
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        for (int k = 0; k < 3; ++k) half[row][column] += f[row][k] * p[k][column];
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        for (int k = 0; k < 3; ++k) ahead[row][column] += half[row][k] * f[column][k];
    std::array<double, 3> gain{};
    double change = 0;
    for (int row = 0; row < 3; ++row) {
      gain[row] = ahead[row][0] / (ahead[0][0] + r);
      change = std::max(change, std::abs(gain[row] - gain_[row]) / std::abs(gain[row]));
    }
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) p[row][column] = ahead[row][column] - gain[row] * ahead[0][column];
    gain_ = gain;
    if (change < kSettled) return;
  }
}

Vec3 VelocityEstimator::filter(const Vec3& difference) noexcept {
  const Vec3 y = filter_.b[0] * (difference + shape_[0] * x1_ + shape_[1] * x2_) - filter_.a[1] * y1_ - filter_.a[2] * y2_;
  x2_ = x1_;
  x1_ = difference;
  y2_ = y1_;
  y1_ = y;
  return y;
}

Vec3 VelocityEstimator::correct(const Vec3& measured) noexcept {
  const Vec3 place = place_ + dt * speed_ + (dt * dt / 2) * acceleration_, speed = speed_ + dt * acceleration_;
  const Vec3 error = measured - place;
  place_ = place + gain_[0] * error;
  speed_ = speed + gain_[1] * error;
  acceleration_ += gain_[2] * error;
  return speed_;
}

// Longer and longer windows that end now, until a sample within one is off its line.
Vec3 VelocityEstimator::slope() const noexcept {
  constexpr int kSize = kMaxWindowDuration + 1;
  const auto sample = [&](int back) { return window_[static_cast<std::size_t>((count_ - 1 - back + 2 * kSize) % kSize)]; };
  const Vec3 now = sample(0);
  Vec3 best;
  for (int length = 1; length < std::min(count_, kSize); ++length) {
    const Vec3 rate = (now - sample(length)) / length;  // [m/tick]
    for (int back = 1; back < length; ++back) {
      const Vec3 off = sample(back) - (now - back * rate);
      if (std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) > kWindowNoise) return best / dt;
    }
    best = rate;
  }
  return best / dt;
}

Vec3 VelocityEstimator::estimate(const DeviceSample& sample) noexcept {
  if (count_ == 0) {
    x1_ = x2_ = y1_ = y2_ = {};
    speed_ = acceleration_ = {};
    last_ = place_ = sample.position;
  }
  constexpr int kSize = kMaxWindowDuration + 1;
  if (kind_ == Kind::Window) window_[static_cast<std::size_t>(count_ % kSize)] = sample.position;
  count_ = count_ < 2 * kSize - 1 ? count_ + 1 : kSize;
  const Vec3 before = last_;
  last_ = sample.position;
  if (fromDevice_ && sample.hasVelocity) return sample.velocity;
  const Vec3 difference = (sample.position - before) / dt;
  switch (kind_) {
    case Kind::Difference: return difference;
    case Kind::Kalman: return correct(sample.position);
    case Kind::Window: return slope();
    case Kind::Recursive: break;
  }
  return filter(difference);
}

double velocityDelay(const experiment::VelocityEstimatorSpec& spec) {
  constexpr double kDifference = kTickSeconds / 2;
  const double ofCutoff = 1 / (2 * std::numbers::pi * spec.cutoff);
  if (spec.kind == "device" || spec.kind == "kalman") return 0;
  if (spec.kind == "difference") return kDifference;
  if (spec.kind == "low-pass") return kDifference + ofCutoff;
  if (spec.kind == "adaptive-window") return VelocityEstimator::kMaxWindowDuration * kTickSeconds / 2;
  return kDifference + std::numbers::sqrt2 * ofCutoff;
}

}  // namespace reachlab::haptics
