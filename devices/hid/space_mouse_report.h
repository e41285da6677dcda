#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "base/math/vec3.h"

/// Reports of 3Dconnexion's SpaceMouse family: the report ID, then little-endian int16 values with the logical range -350 … 350.
///   ID 1, 7 bytes: x, y, z · ID 2, 7 bytes: rx, ry, rz · ID 1, 13 bytes: all six (newer ones) · ID 3: buttons, 2 to 4 bytes
/// Axes of the sensor: x right, y towards the user, z down. The length of the reports tells the layout of a device. The product ID does
/// not.
namespace reachlab::devices {

struct SpaceMouseState {
  Vec3 push;  // -1 … 1, world frame
  std::uint32_t buttons = 0;
};

/// Takes one report, or several whole reports that were joined on the way, into `state`. False when no report was found. Values beyond the
/// range are limited to it.
bool takeSpaceMouseReport(std::span<const std::uint8_t> report, SpaceMouseState& state) noexcept;

}  // namespace reachlab::devices
