#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "base/math/vec3.h"

/// Reports of 3Dconnexion's SpaceMouse family: report ID, then little-endian int16, logical range -350 … 350.
///   ID 1, 7 bytes: x, y, z · ID 2, 7 bytes: rx, ry, rz · ID 1, 13 bytes: all six (newer ones) · ID 3: buttons, 2 to 4 bytes
/// Sensor: x right, y towards the user, z down. What layout a device has is told by the length of its reports, not by its product ID.
namespace reachlab::devices {

struct SpaceMouseState {
  Vec3 push;  // -1 … 1, world frame
  std::uint32_t buttons = 0;
};

/// Takes one report, or several whole ones that were joined on the way, into `state`; false when there was none of these. Values beyond
/// the range are held to it.
bool takeSpaceMouseReport(std::span<const std::uint8_t> report, SpaceMouseState& state) noexcept;

}  // namespace reachlab::devices
