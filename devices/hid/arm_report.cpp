#include "devices/hid/arm_report.h"

#include <algorithm>
#include <cmath>

namespace reachlab::devices {
namespace {

constexpr std::int16_t kButtonOffset = 10000, kButtonFrom = 5000;

std::int16_t get(std::span<const std::uint8_t> bytes, std::size_t field) noexcept {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[2 * field] | bytes[2 * field + 1] << 8));
}

void put(std::span<std::uint8_t> bytes, std::size_t field, std::int16_t value) noexcept {
  const auto bits = static_cast<std::uint16_t>(value);
  bytes[1 + 2 * field] = static_cast<std::uint8_t>(bits & 0xFF);
  bytes[2 + 2 * field] = static_cast<std::uint8_t>(bits >> 8);
}

std::int16_t milliamperes(double amperes) noexcept {
  constexpr double kMost = 32767;
  if (!std::isfinite(amperes)) return 0;
  return static_cast<std::int16_t>(std::clamp(std::round(1000 * amperes), -kMost, kMost));
}

}  // namespace

std::optional<ArmReport> decodeArmReport(std::span<const std::uint8_t> bytes) noexcept {
  if (bytes.size() < kArmPayloadBytes) return std::nullopt;
  ArmReport report;
  for (std::size_t i = 0; i < 6; ++i) report.encoders[i] = get(bytes, i);
  if (report.encoders[3] > kButtonFrom) {
    report.button = true;
    report.encoders[3] = static_cast<std::int16_t>(report.encoders[3] - kButtonOffset);
  }
  report.calibrationButton = (get(bytes, 6) & 1) != 0;
  return report;
}

void encodeArmCommand(const ArmCommand& command, std::span<std::uint8_t> bytes) noexcept {
  std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});
  if (bytes.size() < 1 + kArmPayloadBytes) return;
  put(bytes, 3, command.kind);
  for (std::size_t i = 0; i < 3; ++i) {
    const bool sets = command.kind == ArmCommand::SetEncoders;
    put(bytes, i, sets ? command.encoders[3 + i] : milliamperes(command.currents[i]));
    put(bytes, 4 + i, sets ? command.encoders[i] : std::int16_t{0});
  }
}

}  // namespace reachlab::devices
