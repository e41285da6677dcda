#pragma once
#include <array>

namespace reachlab {

/// Second-order section y = b0 x + b1 x' + b2 x'' - a1 y' - a2 y'', a0 = 1. Primes are one and two samples back.
struct Biquad {
  std::array<double, 3> b{};
  std::array<double, 3> a{};
};

/// Butterworth low-pass of second order, 1/(s^2 + sqrt(2) s + 1), by the bilinear transform with pre-warped cut-off: -3 dB at `cutoff` in
/// one pass. The caller checks 0 < cutoff [Hz] < 1/(2 dt) and dt > 0 [s] between samples. Any thread.
Biquad butterworthLowPass(double cutoff, double dt) noexcept;

}  // namespace reachlab
