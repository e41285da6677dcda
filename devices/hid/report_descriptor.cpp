#include "devices/hid/report_descriptor.h"

#include <fstream>
#include <iterator>

namespace reachlab::devices {

std::size_t inputReportBytes(std::span<const std::uint8_t> descriptor) noexcept {
  // Items without their size in bytes, which the two lowest bits tell.
  constexpr std::uint8_t kSizes = 3, kInput = 0x80, kReportSize = 0x74, kReportCount = 0x94, kReportNumber = 0x84, kPush = 0xA4,
                         kPop = 0xB4;
  constexpr std::uint64_t kMostBits = 64 * 1024 * 8;
  std::uint64_t bits = 0, size = 0, count = 0;
  while (!descriptor.empty()) {
    const std::uint8_t item = descriptor[0] & static_cast<std::uint8_t>(~kSizes);
    const std::size_t bytes = (descriptor[0] & kSizes) == 3 ? 4 : descriptor[0] & kSizes;
    if (descriptor[0] == 0xFE || descriptor.size() < 1 + bytes) return 0;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value |= std::uint64_t{descriptor[1 + i]} << 8 * i;
    descriptor = descriptor.subspan(1 + bytes);
    if (item == kReportNumber || item == kPush || item == kPop) return 0;
    if (item == kReportSize) size = value;
    if (item == kReportCount) count = value;
    if (item == kInput) bits += size * count;  // both below 2^32: no sum of them wraps before it is too large
    if (bits > kMostBits) return 0;
  }
  return (bits + 7) / 8;
}

namespace {

std::vector<std::uint8_t> readFromSystem(const std::string& hidraw) {
  const std::string node = hidraw.substr(hidraw.rfind('/') + 1);
  std::ifstream in("/sys/class/hidraw/" + node + "/device/report_descriptor", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace

std::vector<std::uint8_t> (*readSystemDescriptor)(const std::string&) = readFromSystem;

}  // namespace reachlab::devices
