#include "devices/hid/report_descriptor.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "base/fault.h"

namespace reachlab::devices {
namespace {

constexpr std::size_t kMostFields = 4096;
constexpr std::uint32_t kMostBits = 64 * 1024 * 8;

struct Globals {
  std::uint16_t page = 0;
  std::int32_t least = 0, most = 0;
  std::uint32_t size = 0, count = 0;
  std::uint8_t report = 0;
};

struct Locals {
  std::vector<HidUsage> usages;
  std::optional<HidUsage> first, last;
};

[[noreturn]] void refuse(const char* what) { throw FaultError(Fault{"report descriptor", what}); }

class Parser {
 public:
  explicit Parser(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  HidLayout parse() {
    while (!bytes_.empty()) item();
    if (!collections_.empty()) refuse("a collection is not closed");
    return std::move(layout_);
  }

 private:
  void item() {
    const std::uint8_t head = bytes_[0];
    if (head == 0xFE) refuse("a long item");
    const std::size_t size = (head & 3) == 3 ? 4 : head & 3;
    if (bytes_.size() < 1 + size) refuse("breaks off");
    std::uint32_t raw = 0;
    for (std::size_t i = 0; i < size; ++i) raw |= std::uint32_t{bytes_[1 + i]} << 8 * i;
    std::int32_t value = static_cast<std::int32_t>(raw);
    if (size == 1) value = static_cast<std::int8_t>(raw);
    if (size == 2) value = static_cast<std::int16_t>(raw);
    bytes_ = bytes_.subspan(1 + size);
    const std::uint8_t tag = head >> 4;
    switch (head >> 2 & 3) {
      case 0: main(tag, raw); break;
      case 1: global(tag, raw, value); break;
      case 2: local(tag, raw, size); break;
      default: break;
    }
  }
  void main(std::uint8_t tag, std::uint32_t raw) {
    switch (tag) {
      case 0x8: fields(HidReportKind::Input, raw); break;
      case 0x9: fields(HidReportKind::Output, raw); break;
      case 0xB: fields(HidReportKind::Feature, raw); break;
      case 0xA: collections_.push_back(local_.usages.empty() ? 0 : local_.usages.front()); break;
      case 0xC:
        if (collections_.empty()) refuse("closes a collection that is not open");
        collections_.pop_back();
        break;
      default: break;
    }
    local_ = {};
  }
  void global(std::uint8_t tag, std::uint32_t raw, std::int32_t value) {
    switch (tag) {
      case 0x0: global_.page = static_cast<std::uint16_t>(raw); break;
      case 0x1: global_.least = value; break;
      // 255 in one byte is meant as 255 where the least is not negative.
      case 0x2: global_.most = global_.least >= 0 && value < 0 ? static_cast<std::int32_t>(raw) : value; break;
      case 0x7: global_.size = raw; break;
      case 0x8:
        global_.report = static_cast<std::uint8_t>(raw);
        layout_.numbered = true;
        break;
      case 0x9: global_.count = raw; break;
      case 0xA: stack_.push_back(global_); break;
      case 0xB:
        if (stack_.empty()) refuse("takes back globals that were not kept");
        global_ = stack_.back();
        stack_.pop_back();
        break;
      default: break;
    }
  }
  void local(std::uint8_t tag, std::uint32_t raw, std::size_t size) {
    const HidUsage usage = size == 4 ? raw : hidUsage(global_.page, static_cast<std::uint16_t>(raw));
    if (tag == 0x0) local_.usages.push_back(usage);
    if (tag == 0x1) local_.first = usage;
    if (tag == 0x2) local_.last = usage;
    if (!local_.first || !local_.last) return;
    if (*local_.last < *local_.first || *local_.last - *local_.first > kMostFields) refuse("a range of usages");
    for (HidUsage at = *local_.first; at <= *local_.last; ++at) local_.usages.push_back(at);
    local_.first = local_.last = std::nullopt;
  }
  std::uint32_t& lengthOf(HidReportKind kind) {
    const auto key = std::make_pair(kind, global_.report);
    const auto at = std::find_if(layout_.lengths.begin(), layout_.lengths.end(), [&](const auto& one) { return one.first == key; });
    if (at != layout_.lengths.end()) return at->second;
    return layout_.lengths.emplace_back(key, 0u).second;
  }
  void fields(HidReportKind kind, std::uint32_t flags) {
    constexpr std::uint32_t kConstant = 1, kVariable = 2;
    std::uint32_t& length = lengthOf(kind);
    if (global_.count > kMostFields * 16 || std::uint64_t{length} + std::uint64_t{global_.size} * global_.count > kMostBits)
      refuse("a report of unreasonable size");
    for (std::uint32_t i = 0; i < global_.count; ++i, length += global_.size) {
      if ((flags & kConstant) != 0 || local_.usages.empty() || global_.size == 0 || global_.size > 32) continue;
      if (layout_.fields.size() >= kMostFields) refuse("more fields than reasonable");
      HidField field;
      field.kind = kind;
      field.report = global_.report;
      field.array = (flags & kVariable) == 0;
      if (field.array) field.usages = local_.usages;
      else field.usages = {local_.usages[std::min<std::size_t>(i, local_.usages.size() - 1)]};
      field.least = global_.least, field.most = global_.most;
      field.bit = length, field.bits = global_.size;
      field.collections = collections_;
      layout_.fields.push_back(std::move(field));
    }
  }

  std::span<const std::uint8_t> bytes_;
  HidLayout layout_;
  Globals global_;
  std::vector<Globals> stack_;
  Locals local_;
  std::vector<HidUsage> collections_;
};

}  // namespace

HidLayout parseReportDescriptor(std::span<const std::uint8_t> bytes) { return Parser(bytes).parse(); }

const HidField* HidLayout::find(HidReportKind kind, HidUsage usage, HidUsage within) const {
  for (const HidField& field : fields) {
    if (field.kind != kind) continue;
    if (within != 0 && std::find(field.collections.begin(), field.collections.end(), within) == field.collections.end()) continue;
    if (std::find(field.usages.begin(), field.usages.end(), usage) != field.usages.end()) return &field;
  }
  return nullptr;
}

std::size_t HidLayout::bytesOf(HidReportKind kind, std::uint8_t report) const {
  for (const auto& [key, bits] : lengths)
    if (key == std::make_pair(kind, report)) return (bits + 7) / 8;
  return 0;
}

std::optional<std::int32_t> readField(const HidLayout& layout, const HidField& field, std::span<const std::uint8_t> report) noexcept {
  if (layout.numbered) {
    if (report.empty() || report[0] != field.report) return std::nullopt;
    report = report.subspan(1);
  }
  if (field.bit + field.bits > report.size() * 8) return std::nullopt;
  std::uint64_t raw = 0;
  for (std::uint32_t i = 0; i < field.bits; ++i) {
    const std::uint32_t at = field.bit + i;
    raw |= static_cast<std::uint64_t>(report[at / 8] >> at % 8 & 1) << i;
  }
  if (field.least < 0 && (raw >> (field.bits - 1) & 1) != 0) raw |= ~std::uint64_t{0} << field.bits;
  const auto value = static_cast<std::int64_t>(raw);
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(value, INT32_MIN, INT32_MAX));
}

void writeField(const HidField& field, std::int32_t value, std::span<std::uint8_t> report) noexcept {
  if (report.empty() || field.bit + field.bits > (report.size() - 1) * 8) return;
  report[0] = field.report;
  const std::int32_t bounded = field.most > field.least ? std::clamp(value, field.least, field.most) : value;
  const auto raw = static_cast<std::uint32_t>(bounded);
  for (std::uint32_t i = 0; i < field.bits; ++i) {
    const std::uint32_t at = 8 + field.bit + i;
    const auto bit = static_cast<std::uint8_t>(1u << at % 8);
    report[at / 8] = static_cast<std::uint8_t>((raw >> i & 1) != 0 ? report[at / 8] | bit : report[at / 8] & ~bit);
  }
}

void writeUsage(const HidField& field, HidUsage usage, std::span<std::uint8_t> report) noexcept {
  if (!field.array) {
    writeField(field, field.usages.front() == usage ? 1 : 0, report);
    return;
  }
  const auto at = std::find(field.usages.begin(), field.usages.end(), usage);
  if (at != field.usages.end()) writeField(field, field.least + static_cast<std::int32_t>(at - field.usages.begin()), report);
}

std::vector<std::uint8_t> readSystemDescriptor(const std::string& hidraw) {
  const std::string node = hidraw.substr(hidraw.rfind('/') + 1);
  std::ifstream in("/sys/class/hidraw/" + node + "/device/report_descriptor", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

}  // namespace reachlab::devices
