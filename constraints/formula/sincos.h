#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/math/elementary.h"
#include "base/math/fused.h"

namespace reachlab::constraints {

/// Sine and cosine together, inlined. Every fused operation is written out, so that generated code and typed formulas give the same bits in
/// every build. The absolute error is below 1.7e-16 for |x| <= kSinCosLimit. Beyond it, and for numbers that are not finite, elementary.h
/// is used. Reduction to |y| <= pi/4 after Cody and Waite (Software Manual for the Elementary Functions, 1980, ch. 8): pi/2 has three
/// parts. The first two are short enough that their products with the quadrant number are exact. Polynomials: minimax fits on [0,
/// (pi/4)^2], printed by `constraints/generate/sincos_coefficients.py`.
inline constexpr double kSinCosLimit = 1e5;

namespace sincosDetail {
inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
inline constexpr double kHalfPi1 = 0x1.921fb544p0;         // 33 bits of pi/2
inline constexpr double kHalfPi2 = 0x1.0b4611a6p-34;       // the next 33
inline constexpr double kHalfPi3 = 0x1.3198a2e037073p-69;  // the rest
inline constexpr double kRound = 0x1.8p52;                 // adding it leaves the nearest whole number in the low bits

inline constexpr double kSin[6] = {-0x1.5555555555549p-3, 0x1.111111110f8b8p-7,   -0x1.a01a019c19ad9p-13,
                                   0x1.71de357f00e11p-19, -0x1.ae5e6c2316079p-26, 0x1.5d94c4e881cb6p-33};
inline constexpr double kCos[6] = {0x1.555555555554cp-5,   -0x1.6c16c16c1524bp-10, 0x1.a01a019cc6d12p-16,
                                   -0x1.27e4f819dbc9cp-22, 0x1.1ee9f72c95fbap-29,  -0x1.8fb4a8dd0ba2dp-37};
}  // namespace sincosDetail

/// Without a branch, for loops over lanes: 1 where x is beyond the limit and the result of no use, else 0. (g++ 12 keeps no bool in lanes.)
[[gnu::always_inline]] inline std::uint64_t sinCosNear(double x, double& sine, double& cosine) noexcept {
  using namespace sincosDetail;
  const double shifted = mulAdd(x, kTwoOverPi, kRound);
  const double quadrant = shifted - kRound;
  const std::uint64_t q = std::bit_cast<std::uint64_t>(shifted);
  const double y = mulAdd(-quadrant, kHalfPi3, mulAdd(-quadrant, kHalfPi2, mulAdd(-quadrant, kHalfPi1, x)));
  const double z = y * y;
  const double w = z * z;
  // Estrin's scheme: shorter chains than Horner's.
  const double sinSeries = mulAdd(w, mulAdd(w, mulAdd(z, kSin[5], kSin[4]), mulAdd(z, kSin[3], kSin[2])), mulAdd(z, kSin[1], kSin[0]));
  const double cosSeries = mulAdd(w, mulAdd(w, mulAdd(z, kCos[5], kCos[4]), mulAdd(z, kCos[3], kCos[2])), mulAdd(z, kCos[1], kCos[0]));
  const double s = mulAdd(y * z, sinSeries, y);
  const double c = 1.0 - mulAdd(-w, cosSeries, 0.5 * z);
  const bool swap = (q & 1) != 0;
  const std::uint64_t sinBits = std::bit_cast<std::uint64_t>(swap ? c : s) ^ ((q & 2) << 62);
  const std::uint64_t cosBits = std::bit_cast<std::uint64_t>(swap ? s : c) ^ (((q + 1) & 2) << 62);
  sine = std::bit_cast<double>(sinBits);
  cosine = std::bit_cast<double>(cosBits);
  return std::abs(x) <= kSinCosLimit ? 0 : 1;
}

[[gnu::always_inline]] inline void sinCos(double x, double& sine, double& cosine) noexcept {
  if (!(std::abs(x) <= kSinCosLimit)) [[unlikely]] {
    sine = elementary::sin(x);
    cosine = elementary::cos(x);
    return;
  }
  sinCosNear(x, sine, cosine);
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
/// Returns -1, 0 or 1. NaN remains NaN.
inline double signOf(double x) noexcept { return x > 0 ? 1.0 : x < 0 ? -1.0 : x; }

}  // namespace reachlab::constraints
