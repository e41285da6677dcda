#include "base/math/butterworth.h"

#include <numbers>

#include "base/math/elementary.h"

namespace reachlab {

Biquad butterworthLowPass(double cutoff, double dt) noexcept {
  const double w = elementary::tan(std::numbers::pi * cutoff * dt);  // s = (1 - z^-1)/(1 + z^-1)/w
  const double norm = 1 + std::numbers::sqrt2 * w + w * w, gain = w * w / norm;
  return {{gain, 2 * gain, gain}, {1, 2 * (w * w - 1) / norm, (1 - std::numbers::sqrt2 * w + w * w) / norm}};
}

}  // namespace reachlab
