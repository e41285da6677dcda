#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace reachlab::devices {

/// One HID interface that the system shows.
struct HidInterface {
  std::string path;  // "/dev/hidraw0"
  std::uint16_t vendor = 0, product = 0;
  std::string serial, maker, title;
  /// What a user writes behind the colon: the serial number, or the path where it has none.
  const std::string& key() const { return serial.empty() ? path : serial; }
};

/// All of this vendor and product (0: any), in the order of their paths.
std::vector<HidInterface> findHid(std::uint16_t vendor = 0, std::uint16_t product = 0);
/// Why this user may not read and write it, with what to do; empty when he may.
std::string whyNotOpen(const HidInterface& interface);

/// An open HID interface: reports out and in. One thread at a time.
class HidPort {
 public:
  virtual ~HidPort() = default;
  /// Bytes of the newest waiting report, read within `milliseconds`; 0: none came; -1: the device is gone. A report without number comes
  /// without its ID byte.
  virtual int read(std::span<std::uint8_t> bytes, int milliseconds) noexcept = 0;
  /// True when it was sent. The first byte is the report's number, 0 where reports have none.
  virtual bool write(std::span<const std::uint8_t> bytes) noexcept = 0;
};

/// Throws ResourceError in the system's words.
std::unique_ptr<HidPort> openHid(const HidInterface& interface);

}  // namespace reachlab::devices
