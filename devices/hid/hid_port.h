#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/system/descriptor.h"

struct hid_device_;  // of hidapi

namespace reachlab::devices {

/// One HID interface that the system lists.
struct HidInterface {
  std::string path = {};  // "/dev/hidraw0"
  std::uint16_t vendor = 0, product = 0;
  std::string serial = {}, maker = {}, title = {};
  /// The text that a user writes behind the colon: the serial number, or the path of an interface without a serial number.
  const std::string& key() const { return serial.empty() ? path : serial; }
};

/// All interfaces of this vendor and product (0: any), in the order of their paths.
std::vector<HidInterface> findHid(std::uint16_t vendor = 0, std::uint16_t product = 0);
/// The interface of that key or path, or the first one where `key` is empty. Null when it is not among them.
const HidInterface* chooseHid(const std::vector<HidInterface>& interfaces, const std::string& key);
/// The reason why this user may not read and write the interface, with the remedy. Empty when the user may.
std::string whyNotOpen(const HidInterface& interface);

/// An open HID interface that sends and receives reports. One thread at a time.
class HidPort {
 public:
  /// Throws ResourceError with the system's message.
  explicit HidPort(const HidInterface& interface);
  ~HidPort();
  HidPort(const HidPort&) = delete;
  HidPort& operator=(const HidPort&) = delete;
  /// The number of bytes of the newest waiting report, read within `milliseconds`. 0: no report came. -1: the device is gone. A report
  /// without a number comes without its ID byte.
  int read(std::span<std::uint8_t> bytes, int milliseconds) noexcept;
  /// True when the report was sent. The first byte is the report's number, or 0 for reports without a number.
  bool write(std::span<const std::uint8_t> bytes) noexcept;

 private:
  os::Descriptor alone_;
  hid_device_* device_;
};

}  // namespace reachlab::devices
