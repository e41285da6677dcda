#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

namespace reachlab {

/// Sine and cosine together, inlined, without contraction or fused operations: the same bits on every machine, in generated code and
/// in typed formulas. Absolute error below 1.7e-16 for |x| <= kSinCosLimit; libm beyond (and for what is not finite).
/// Reduction to |y| <= pi/4 after Cody and Waite (Software Manual for the Elementary Functions, 1980, ch. 8): pi/2 in three parts, the
/// first two short enough that their products with the quadrant number are exact. Polynomials: minimax fits on [0, (pi/4)^2],
/// `constraints/generate/sincos_coefficients.py` prints them.
inline constexpr double kSinCosLimit = 1e5;

namespace sincosDetail {
inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
inline constexpr double kHalfPi1 = 0x1.921fb544p0;          // 33 bits of pi/2
inline constexpr double kHalfPi2 = 0x1.0b4611a6p-34;        // the next 33
inline constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;   // the rest
inline constexpr double kRound = 0x1.8p52;                  // adding it leaves the nearest whole number in the low bits

inline constexpr double kSin[6] = {
    -0x1.5555555555549p-3,  0x1.111111110f8b8p-7,  -0x1.a01a019c19ad9p-13,
    0x1.71de357f00e11p-19, -0x1.ae5e6c2316079p-26, 0x1.5d94c4e881cb6p-33};
inline constexpr double kCos[6] = {
    0x1.555555555554cp-5,   -0x1.6c16c16c1524bp-10, 0x1.a01a019cc6d12p-16,
    -0x1.27e4f819dbc9cp-22, 0x1.1ee9f72c95fbap-29,  -0x1.8fb4a8dd0ba2dp-37};
}  // namespace sincosDetail

[[gnu::always_inline]] inline void sinCos(double x, double& sine, double& cosine) noexcept {
  using namespace sincosDetail;
  if (!(std::abs(x) <= kSinCosLimit)) [[unlikely]] {
    sine = std::sin(x);
    cosine = std::cos(x);
    return;
  }
  const double shifted = x * kTwoOverPi + kRound;
  const double quadrant = shifted - kRound;
  const std::uint64_t q = std::bit_cast<std::uint64_t>(shifted);
  const double y = ((x - quadrant * kHalfPi1) - quadrant * kHalfPi2) - quadrant * kHalfPi3;
  const double z = y * y;
  const double w = z * z;
  // Estrin's scheme: shorter chains than Horner's.
  const double s = y + (y * z) * ((kSin[0] + z * kSin[1]) + w * ((kSin[2] + z * kSin[3]) + w * (kSin[4] + z * kSin[5])));
  const double c = 1.0 - (0.5 * z - w * ((kCos[0] + z * kCos[1]) + w * ((kCos[2] + z * kCos[3]) + w * (kCos[4] + z * kCos[5]))));
  const bool swap = (q & 1) != 0;
  const std::uint64_t sinBits = std::bit_cast<std::uint64_t>(swap ? c : s) ^ ((q & 2) << 62);
  const std::uint64_t cosBits = std::bit_cast<std::uint64_t>(swap ? s : c) ^ (((q + 1) & 2) << 62);
  sine = std::bit_cast<double>(sinBits);
  cosine = std::bit_cast<double>(cosBits);
}

inline double sine(double x) noexcept {
  double s, c;
  sinCos(x, s, c);
  return s;
}
inline double cosine(double x) noexcept {
  double s, c;
  sinCos(x, s, c);
  return c;
}
/// -1, 0 or 1; not a number stays one.
inline double signOf(double x) noexcept { return x > 0 ? 1.0 : x < 0 ? -1.0 : x; }

}  // namespace reachlab
