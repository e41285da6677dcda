#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Report descriptors of HID 1.11, sec. 6.2.2. The functions are pure, except the function that reads a file. Any thread may call them.
namespace reachlab::devices {

/// The number of bytes of an input report, for a device whose reports have no number. 0 means unknown: the descriptor is broken, or it has
/// a form that this function does not read (report numbers, long items, kept globals).
std::size_t inputReportBytes(std::span<const std::uint8_t> descriptor) noexcept;

/// The descriptor of /dev/hidrawN as the system keeps it. Empty when the system has no descriptor. Another reader may take its place
/// before a device is opened.
extern std::vector<std::uint8_t> (*readSystemDescriptor)(const std::string& hidraw);

}  // namespace reachlab::devices
