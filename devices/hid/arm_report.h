#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

/// Reports of the open arms' firmware: packed little-endian int16. The payload is fourteen bytes at the begin of a report without ID. The
/// other bytes are zero.
namespace reachlab::devices {

inline constexpr std::size_t kArmPayloadBytes = 14;

/// Device to host.
struct ArmReport {
  std::array<std::int16_t, 6> encoders{};  // a, b, c, then d, e, f of the gimbal (0 on arms without a gimbal)
  bool button = false;                     // folded into encoder d by the firmware
  bool calibrationButton = false;          // latched until encoders are set
};
/// Returns nullopt when the bytes are fewer than the payload.
std::optional<ArmReport> decodeArmReport(std::span<const std::uint8_t> bytes) noexcept;

/// Host to device.
struct ArmCommand {
  enum Kind : std::int16_t { Currents = 0, SetEncoders = 1 };
  Kind kind = Currents;
  std::array<double, 3> currents{};        // [A]
  std::array<std::int16_t, 6> encoders{};  // SetEncoders: the present counts of the encoders
};
/// Report ID 0 and the payload, then zeros up to `bytes.size()` (15 or 65). Currents are limited to the range of a report and never
/// wrapped.
void encodeArmCommand(const ArmCommand& command, std::span<std::uint8_t> bytes) noexcept;

/// A count that continues past the ends of int16. Each step is taken as the shorter of the two possible steps.
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
