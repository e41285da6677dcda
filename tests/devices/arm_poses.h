#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "devices/hid/open_serial_arm.h"

/// The way back from where a handle is to what the arm's encoders count: what a model of its firmware needs.
namespace reachlab::devices {

/// Encoder counts of joint angles [rad], not rounded.
inline std::array<double, 3> encoderCounts(const ArmModel& m, const std::array<double, 3>& angles) {
  std::array<double, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i)
    counts[i] = (m.aligned[i] ? -1 : 1) * angles[i] * m.body[i] / m.capstan[i] * m.countsPerTurn / (2 * std::numbers::pi);
  return counts;
}

/// The angles that bring the handle to `place` [m], elbow as in the workspace; not a number where the arm does not reach. In the arm's
/// plane: lb (sin thB, cos thB) + lc (sin thC, -cos thC) = (out, up). With thC' = pi - thC it is a plain two-link chain of angles from the
/// vertical; the elbow lies towards the user's side of the line when thB < thC'.
inline std::array<double, 3> anglesAt(const ArmModel& m, const Vec3& place) {
  const Vec3 p = place + m.origin;
  const double out = std::hypot(p.x, p.y), up = p.z - m.length[0], reach2 = out * out + up * up;
  const double lb = m.length[1], lc = m.length[2];
  const double towards = std::atan2(out, up);  // from the vertical
  const double spread = std::acos((reach2 + lb * lb - lc * lc) / (2 * lb * std::sqrt(reach2)));
  const double thB = towards - spread;
  const double lowerOut = out - lb * std::sin(thB), lowerUp = up - lb * std::cos(thB);
  return {std::atan2(p.y, p.x), thB, std::atan2(lowerOut, -lowerUp)};
}

}  // namespace reachlab::devices
