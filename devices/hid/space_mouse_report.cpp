#include "devices/hid/space_mouse_report.h"

#include <algorithm>

namespace reachlab::devices {
namespace {

constexpr double kRange = 350;
constexpr std::size_t kThreeAxes = 7, kSixAxes = 13;  // bytes

double axis(std::span<const std::uint8_t> report, std::size_t at) noexcept {
  const auto raw = static_cast<std::int16_t>(static_cast<std::uint16_t>(report[at] | report[at + 1] << 8));
  return std::clamp(raw / kRange, -1.0, 1.0);
}

// Sensor to world: (x, -z, y).
Vec3 axes(std::span<const std::uint8_t> report, std::size_t at) noexcept {
  return {axis(report, at), -axis(report, at + 4), axis(report, at + 2)};
}

void takeOne(std::span<const std::uint8_t> report, SpaceMouseState& state) noexcept {
  if (report[0] == 1) state.push = axes(report, 1);
  if (report[0] != 3) return;  // report 2 is a twist, which steers nothing
  state.buttons = 0;
  for (std::size_t i = 1; i < report.size(); ++i) state.buttons |= std::uint32_t{report[i]} << 8 * (i - 1);
}

// How long the report is that these bytes begin with; 0: none of ours.
std::size_t lengthOf(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes[0] == 3) return bytes.size() >= 2 && bytes.size() <= 5 ? bytes.size() : 0;
  if (bytes[0] != 1 && bytes[0] != 2) return 0;
  if (bytes[0] == 1 && bytes.size() % kSixAxes == 0) return kSixAxes;
  return bytes.size() % kThreeAxes == 0 ? kThreeAxes : 0;
}

}  // namespace

bool takeSpaceMouseReport(std::span<const std::uint8_t> bytes, SpaceMouseState& state) noexcept {
  bool taken = false;
  while (!bytes.empty()) {
    const std::size_t length = lengthOf(bytes);
    if (length == 0) break;
    takeOne(bytes.first(length), state);
    taken = true;
    bytes = bytes.subspan(length);
  }
  return taken;
}

}  // namespace reachlab::devices
