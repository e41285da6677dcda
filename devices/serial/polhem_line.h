#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/math/vec3.h"

/// The serial protocol of Polhem v3. Lines have 64 bytes and are padded with spaces. The last byte is a line feed. Pure functions that any
/// thread may call.
namespace reachlab::devices {

inline constexpr std::size_t kPolhemLineBytes = 64;

/// `x y z [mm] tA lambda tD tE [rad] info` in the device's axes: x towards the user, y right, z up.
struct PolhemState {
  Vec3 place;  // [m]
  int info = 0;
};
/// Returns nullopt for an incomplete line, for a number that is not finite, and for a position more than a metre from the middle.
std::optional<PolhemState> readPolhemLine(std::string_view line) noexcept;

/// Fx Fy Fz in whole millinewtons and command 2 (a force), in the device's axes [N]. A force that is not finite becomes zero force. The
/// values are limited to 16 bits, and the direction is kept.
std::string polhemForceLine(const Vec3& force);

}  // namespace reachlab::devices
