#pragma once
#include <array>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

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

/// The report of an arm that counts this.
inline std::vector<std::uint8_t> armReport(const std::array<double, 3>& counts) {
  std::vector<std::uint8_t> report(64, 0);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto raw = static_cast<std::uint16_t>(std::llround(counts[i]));
    report[2 * i] = static_cast<std::uint8_t>(raw & 0xFF);
    report[2 * i + 1] = static_cast<std::uint8_t>(raw >> 8);
  }
  return report;
}
/// A field of a command, from its first byte on.
inline std::int16_t fieldOf(std::span<const std::uint8_t> command, std::size_t at) {
  return static_cast<std::int16_t>(command[at] | command[at + 1] << 8);
}
/// The report descriptor of an arm: a vendor's page, one collection, so many bytes in and out without report numbers.
inline std::vector<std::uint8_t> vendorPage(std::uint8_t bytes = 64) {
  return {0x06, 0xAB, 0xFF,  0x0A, 0x00, 0x02, 0xA1, 0x01, 0x15, 0x00, 0x26,  0xFF, 0x00, 0x75,
          0x08, 0x95, bytes, 0x09, 0x01, 0x81, 0x02, 0x09, 0x02, 0x95, bytes, 0x91, 0x02, 0xC0};
}

/// [mA] The largest current of a command.
inline int largestCurrent(std::span<const std::uint8_t> command) {
  return std::max({std::abs(fieldOf(command, 1)), std::abs(fieldOf(command, 3)), std::abs(fieldOf(command, 5))});
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
