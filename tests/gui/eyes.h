#pragma once
#include <QColor>
#include <array>
#include <cmath>

/// How colours look to eyes: of everybody, and of those who lack the middle or the long cones.
namespace reachlab::gui {

using Light = std::array<double, 3>;  // linear RGB

inline Light lightOf(const QColor& colour) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  return {linear(colour.redF()), linear(colour.greenF()), linear(colour.blueF())};
}

// Machado, Oliveira, Fernandes 2009, table 1, severity 1.
inline Light toDeuteranope(const Light& c) {
  return {0.367322 * c[0] + 0.860646 * c[1] - 0.227968 * c[2], 0.280085 * c[0] + 0.672501 * c[1] + 0.047413 * c[2],
          -0.011820 * c[0] + 0.042940 * c[1] + 0.968881 * c[2]};
}
// Of the same table.
inline Light toProtanope(const Light& c) {
  return {0.152286 * c[0] + 1.052583 * c[1] - 0.204868 * c[2], 0.114503 * c[0] + 0.786281 * c[1] + 0.099216 * c[2],
          -0.003882 * c[0] - 0.048116 * c[1] + 1.051998 * c[2]};
}

/// Of everybody, and of those who lack the middle or the long cones.
inline constexpr Light (*kEyes[])(const Light&) = {[](const Light& c) { return c; }, toDeuteranope, toProtanope};

// WCAG 2.1's contrast ratio.
inline double contrast(const Light& a, const Light& b) {
  const auto luminance = [](const Light& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
  const double la = luminance(a) + 0.05, lb = luminance(b) + 0.05;
  return la > lb ? la / lb : lb / la;
}

// CIE 1976 L*a*b*, D65.
inline std::array<double, 3> labOf(const Light& c) {
  const double x = (0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2]) / 0.9505, y = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2],
               z = (0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2]) / 1.089;
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(std::max(t, 0.0)) : 7.787 * t + 16.0 / 116; };
  return {116 * f(y) - 16, 500 * (f(x) - f(y)), 200 * (f(y) - f(z))};
}

// 2.3 is just seen.
inline double apart(const Light& a, const Light& b) {
  const auto p = labOf(a), q = labOf(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

}  // namespace reachlab::gui
