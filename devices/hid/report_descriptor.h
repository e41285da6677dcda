#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace reachlab::devices {

/// A usage with its page: page << 16 | id.
using HidUsage = std::uint32_t;
constexpr HidUsage hidUsage(std::uint16_t page, std::uint16_t id) noexcept { return static_cast<HidUsage>(page) << 16 | id; }

enum class HidReportKind : std::uint8_t { Input, Output, Feature };

/// One value in a report (HID 1.11, sec. 6.2.2): a variable of one usage, or an array element whose value is the place of a usage in a list.
struct HidField {
  HidReportKind kind = HidReportKind::Input;
  std::uint8_t report = 0;       // its number; 0: reports have none
  std::vector<HidUsage> usages;  // one for a variable, the list of an array
  bool array = false;
  std::int32_t least = 0, most = 0;   // logical range
  std::uint32_t bit = 0, bits = 0;    // within the report, behind its number
  std::vector<HidUsage> collections;  // that it lies in, outermost first
};

struct HidLayout {
  std::vector<HidField> fields;  // constants left out
  /// The variable of that usage, or the array that lists it, in a report of that kind within a collection (0: any); null: there is none.
  const HidField* find(HidReportKind kind, HidUsage usage, HidUsage within = 0) const;
  /// Bytes of a report behind its number.
  std::size_t bytesOf(HidReportKind kind, std::uint8_t report) const;
  bool numbered = false;                                                                  // reports begin with their number
  std::vector<std::pair<std::pair<HidReportKind, std::uint8_t>, std::uint32_t>> lengths;  // in bits
};

/// Throws FaultError when it is no whole descriptor, or one of unreasonable size.
HidLayout parseReportDescriptor(std::span<const std::uint8_t> bytes);

/// A value of a report that has been received, number included where reports have one; nullopt when it is too short or of another number.
std::optional<std::int32_t> readField(const HidLayout& layout, const HidField& field, std::span<const std::uint8_t> report) noexcept;
/// Sets a value in a report that begins with its number (0 where reports have none); bounded to the field's range. Of an array: the place
/// of `usage` in its list.
void writeField(const HidField& field, std::int32_t value, std::span<std::uint8_t> report) noexcept;
void writeUsage(const HidField& field, HidUsage usage, std::span<std::uint8_t> report) noexcept;

/// The descriptor of /dev/hidrawN as the system keeps it; empty: not to be had.
std::vector<std::uint8_t> readSystemDescriptor(const std::string& hidraw);

}  // namespace reachlab::devices
