#pragma once
#include <algorithm>
#include <cmath>

namespace reachlab::network {

/// Whether a released object comes to rest: its speed in the last second over its speed in a second soon after the release.
class Growth {
 public:
  Growth(double letBe, double end) : letBe_(letBe), end_(end) {}  // [s]
  void add(double t, double speedSquares) {
    if (t > letBe_ + 0.5 && t < letBe_ + 1.5) early_ += speedSquares, ++earlyCount_;
    if (t > end_ - 1) late_ += speedSquares, ++lateCount_;
  }
  double ratio() const {
    constexpr double kStill = 1e-12;  // [m^2/s^2]
    return std::sqrt(late_ / std::max(1, lateCount_) / (early_ / std::max(1, earlyCount_) + kStill));
  }
  /// An object that hardly comes to rest by itself may ring equally long over a link.
  static bool isStable(double ratio, double alone) {
    constexpr double kMost = 1.05, kLikeAlone = 1.3;
    return std::isfinite(ratio) && (ratio < kMost || ratio < kLikeAlone * alone);
  }

 private:
  double letBe_, end_;
  double early_ = 0, late_ = 0;
  int earlyCount_ = 0, lateCount_ = 0;
};

}  // namespace reachlab::network
