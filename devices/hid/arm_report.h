#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

/// Reports of the open arms' firmware: packed little-endian int16, fourteen bytes at the begin of a report without ID; the rest is zero.
namespace reachlab::devices {

inline constexpr std::size_t kArmPayloadBytes = 14;

/// Device -> host.
struct ArmReport {
  std::array<std::int16_t, 6> encoders{};  // a, b, c; d, e, f of the gimbal, 0 on arms without one
  bool button = false;                     // folded into encoder d by the firmware
  bool calibrationButton = false;          // latched until encoders are set
};
/// nullopt: shorter than the payload.
std::optional<ArmReport> decodeArmReport(std::span<const std::uint8_t> bytes) noexcept;

/// Host -> device.
struct ArmCommand {
  enum Kind : std::int16_t { Currents = 0, SetEncoders = 1 };
  Kind kind = Currents;
  std::array<double, 3> currents{};        // [A]
  std::array<std::int16_t, 6> encoders{};  // SetEncoders: what the encoders are now
};
/// Report ID 0 and the payload, zero up to `bytes.size()` (15 or 65). Currents are bounded to what a report can carry, never wrapped.
void encodeArmCommand(const ArmCommand& command, std::span<std::uint8_t> bytes) noexcept;

/// A count that goes on past the ends of int16: each step is taken as the shorter way round.
class UnwrappedCount {
 public:
  double take(std::int16_t raw) noexcept {
    if (!known_) count_ = raw;
    else count_ += static_cast<std::int16_t>(static_cast<std::uint16_t>(raw) - static_cast<std::uint16_t>(last_));
    known_ = true;
    last_ = raw;
    return static_cast<double>(count_);
  }
  void reset() noexcept { known_ = false; }

 private:
  std::int64_t count_ = 0;
  std::int16_t last_ = 0;
  bool known_ = false;
};

}  // namespace reachlab::devices
