#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Report descriptors of HID 1.11, sec. 6.2.2. Pure functions but for the one that reads a file; any thread.
namespace reachlab::devices {

/// Bytes of an input report of a device whose reports have no number. 0: it is not known, because the descriptor is broken or of a form
/// that is not read here (report numbers, long items, kept globals).
std::size_t inputReportBytes(std::span<const std::uint8_t> descriptor) noexcept;

/// The descriptor of /dev/hidrawN as the system keeps it. Empty: the system has none.
std::vector<std::uint8_t> readSystemDescriptor(const std::string& hidraw);

}  // namespace reachlab::devices
