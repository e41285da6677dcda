#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/math/vec3.h"

/// The serial protocol of Polhem v3: lines of 64 bytes, padded with spaces, the last byte a line feed. Pure functions; any thread.
namespace reachlab::devices {

inline constexpr std::size_t kPolhemLineBytes = 64;

/// `x y z [mm] tA lambda tD tE [rad] info`, its own axes: x towards the user, y right, z up.
struct PolhemState {
  Vec3 place;  // [m]
  int info = 0;
};
/// nullopt: not a whole line of that form, or not finite, or farther than a metre from its middle.
std::optional<PolhemState> readPolhemLine(std::string_view line) noexcept;

/// Fx Fy Fz in whole millinewtons and command 2 (a force), its own axes [N]; not finite: none. Bounded to 16 bits, direction kept.
std::string polhemForceLine(const Vec3& force);

}  // namespace reachlab::devices
