#pragma once
#include <array>
#include <cmath>
#include <optional>

namespace reachlab::devices {

/// Unit quaternion (w, x, y, z) of a rotation matrix (rows), computed from its largest component. Returns nullopt when the matrix is no
/// rotation: it is not finite, or the length of a column differs from 1 by more than 1 %.
inline std::optional<std::array<double, 4>> quaternionOf(const std::array<std::array<double, 3>, 3>& m) noexcept {
  for (int column = 0; column < 3; ++column) {
    const double square = m[0][column] * m[0][column] + m[1][column] * m[1][column] + m[2][column] * m[2][column];
    if (!(std::abs(square - 1) < 0.02)) return std::nullopt;
  }
  // 4 q_i^2 for w, x, y, z. Their sum is 4, so the largest is at least 1.
  const std::array<double, 4> squares{1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                                      1 - m[0][0] - m[1][1] + m[2][2]};
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (squares[i] > squares[largest]) largest = i;
  const double twice = std::sqrt(squares[largest]);  // 2 |q_largest|
  const double wx = m[2][1] - m[1][2], wy = m[0][2] - m[2][0], wz = m[1][0] - m[0][1];
  const double xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1];
  std::array<double, 4> q{};
  switch (largest) {
    case 0: q = {twice * twice, wx, wy, wz}; break;
    case 1: q = {wx, twice * twice, xy, xz}; break;
    case 2: q = {wy, xy, twice * twice, yz}; break;
    default: q = {wz, xz, yz, twice * twice}; break;
  }
  for (double& part : q) part /= 2 * twice;
  return q;
}

}  // namespace reachlab::devices
