#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/fault.h"
#include "devices/hid/stick_force.h"

namespace reachlab::devices {
namespace {

// Page 0x0F of the HID usage tables.
constexpr HidUsage pid(std::uint16_t id) { return hidUsage(0x0F, id); }
constexpr HidUsage kSetEffect = pid(0x21), kBlockIndex = pid(0x22), kConstant = pid(0x26), kDuration = pid(0x50), kSamplePeriod = pid(0x51),
                   kGain = pid(0x52), kTriggerButton = pid(0x53), kTriggerRepeat = pid(0x54), kAxesEnable = pid(0x55),
                   kDirectionEnable = pid(0x56), kDirection = pid(0x57), kMagnitude = pid(0x70), kSetConstantForce = pid(0x73),
                   kOperation = pid(0x77), kStart = pid(0x79), kStop = pid(0x7B), kLoopCount = pid(0x7C), kDeviceGainReport = pid(0x7D),
                   kDeviceGain = pid(0x7E), kBlockLoad = pid(0x89), kLoadSuccess = pid(0x8C), kDeviceControl = pid(0x96),
                   kEnableActuators = pid(0x97), kStopAll = pid(0x99), kCreate = pid(0xAB);
constexpr HidUsage kX = hidUsage(0x01, 0x30), kY = hidUsage(0x01, 0x31);
constexpr HidUsage kFirstOrdinal = hidUsage(0x0A, 1), kSecondOrdinal = hidUsage(0x0A, 2);

using Report = std::vector<std::uint8_t>;

class PidForce final : public StickForce {
 public:
  explicit PidForce(const HidLayout& layout) : layout_(layout) {
    const auto need = [&](HidReportKind kind, HidUsage usage, HidUsage within, const char* what) {
      if (layout_.find(kind, usage, within) == nullptr)
        throw FaultError(Fault{"report descriptor", fmt::format("has no {} (HID PID)", what)});
    };
    need(HidReportKind::Feature, kConstant, kCreate, "constant force among Create New Effect");
    need(HidReportKind::Feature, kBlockIndex, kBlockLoad, "Block Load with an Effect Block Index");
    need(HidReportKind::Output, kBlockIndex, kSetEffect, "Set Effect with an Effect Block Index");
    need(HidReportKind::Output, kMagnitude, kSetConstantForce, "Set Constant Force with a Magnitude");
    need(HidReportKind::Output, kStart, kOperation, "Effect Operation with Start");
    full_ = layout_.find(HidReportKind::Output, kMagnitude, kSetConstantForce)->most;
    if (full_ <= 0) throw FaultError(Fault{"report descriptor", "gives Magnitude no range (HID PID)"});
    axes_ = layout_.find(HidReportKind::Output, kY, kAxesEnable) != nullptr ? 2 : 1;
  }

  int axes() const override { return axes_; }

  std::string start(HidPort& port) override {
    control(port, kEnableActuators);
    if (const HidField* gain = layout_.find(HidReportKind::Output, kDeviceGain, kDeviceGainReport)) {
      Report report = blank(HidReportKind::Output, *gain);
      writeField(*gain, gain->most, report);
      port.write(report);
    }
    for (int axis = 0; axis < axes_; ++axis) {
      if (const std::string fault = create(port, axis); !fault.empty()) return fault;
      if (!setEffect(port, axis)) return "it does not take Set Effect";
      if (!magnitude(port, axis, 0) || !operate(port, axis, kStart)) return "its effect does not start";
    }
    told_ = {};
    return {};
  }

  bool tell(HidPort& port, double x, double y) noexcept override {
    const std::array<double, 2> wanted{x, y};
    bool fine = true;
    for (int axis = 0; axis < axes_; ++axis) {
      const auto at = static_cast<std::size_t>(axis);
      const auto value = static_cast<std::int32_t>(std::lround(std::clamp(wanted[at], -1.0, 1.0) * full_));
      if (value == told_[at]) continue;
      fine = magnitude(port, axis, value) && fine;
      told_[at] = value;
    }
    return fine;
  }

  void stop(HidPort& port) noexcept override {
    try {
      for (int axis = 0; axis < axes_; ++axis) {
        magnitude(port, axis, 0);
        operate(port, axis, kStop);
      }
      control(port, kStopAll);
    } catch (const std::exception&) {  // no memory for a report; the device stops with its connection
    }
  }

 private:
  Report blank(HidReportKind kind, const HidField& field) const {
    Report report(layout_.bytesOf(kind, field.report) + 1, 0);
    report[0] = field.report;
    return report;
  }
  void set(Report& report, HidReportKind kind, HidUsage usage, HidUsage within, std::int32_t value) const {
    const HidField* field = layout_.find(kind, usage, within);
    if (field != nullptr && field->report == report[0]) writeField(*field, value, report);
  }
  void choose(Report& report, HidReportKind kind, HidUsage usage, HidUsage within) const {
    const HidField* field = layout_.find(kind, usage, within);
    if (field != nullptr && field->report == report[0]) writeUsage(*field, usage, report);
  }
  // Where the selectors are bits, each is a field of its own; where they are an array, the value is the place in the list.
  bool control(HidPort& port, HidUsage what) const {
    const HidField* field = layout_.find(HidReportKind::Output, what, kDeviceControl);
    if (field == nullptr) return true;
    Report report = blank(HidReportKind::Output, *field);
    writeUsage(*field, what, report);
    return port.write(report);
  }
  std::string create(HidPort& port, int axis) {
    const HidField& type = *layout_.find(HidReportKind::Feature, kConstant, kCreate);
    Report wish = blank(HidReportKind::Feature, type);
    writeUsage(type, kConstant, wish);
    if (!port.sendFeature(wish)) return "it makes no new effect (Create New Effect is refused)";
    const HidField& index = *layout_.find(HidReportKind::Feature, kBlockIndex, kBlockLoad);
    Report answer = blank(HidReportKind::Feature, index);
    if (port.getFeature(answer) < 2) return "it does not tell of its new effect (Block Load)";
    if (const HidField* status = layout_.find(HidReportKind::Feature, kLoadSuccess, kBlockLoad); status != nullptr) {
      const auto told = readIn(*status, answer);
      const auto success =
          status->array ? status->least + static_cast<std::int32_t>(std::find(status->usages.begin(), status->usages.end(), kLoadSuccess) -
                                                                    status->usages.begin())
                        : 1;
      if (told != success) return fmt::format("it has no room for an effect (Block Load Status {})", told.value_or(-1));
    }
    const auto block = readIn(index, answer);
    if (!block || *block <= 0) return "it gives its new effect no number (Block Load)";
    block_[static_cast<std::size_t>(axis)] = *block;
    return {};
  }
  // A feature report is got with its number in front, whether reports have one or not.
  std::optional<std::int32_t> readIn(const HidField& field, const Report& report) const {
    return readField(layout_, field, layout_.numbered ? std::span(report) : std::span(report).subspan(1));
  }
  bool setEffect(HidPort& port, int axis) const {
    constexpr auto kOut = HidReportKind::Output;
    const HidField& index = *layout_.find(kOut, kBlockIndex, kSetEffect);
    Report report = blank(kOut, index);
    const auto most = [&](HidUsage usage) {
      const HidField* field = layout_.find(kOut, usage, kSetEffect);
      return field == nullptr ? 0 : field->most;
    };
    set(report, kOut, kBlockIndex, kSetEffect, block_[static_cast<std::size_t>(axis)]);
    choose(report, kOut, kConstant, kSetEffect);
    set(report, kOut, kDuration, kSetEffect, most(kDuration));  // for ever
    set(report, kOut, kTriggerRepeat, kSetEffect, 0);
    set(report, kOut, kSamplePeriod, kSetEffect, 0);
    set(report, kOut, kGain, kSetEffect, most(kGain));
    set(report, kOut, kTriggerButton, kSetEffect, most(kTriggerButton));  // none
    set(report, kOut, axis == 0 ? kX : kY, kAxesEnable, 1);
    set(report, kOut, kDirectionEnable, kSetEffect, 1);
    // Polar, a turn over the field's range: x is a quarter, y none. A second ordinal is of three axes.
    if (const HidField* direction = layout_.find(kOut, kFirstOrdinal, kDirection))
      set(report, kOut, kFirstOrdinal, kDirection, axis == 0 ? direction->most / 4 : 0);
    set(report, kOut, kSecondOrdinal, kDirection, 0);
    return port.write(report);
  }
  bool magnitude(HidPort& port, int axis, std::int32_t value) const {
    const HidField& field = *layout_.find(HidReportKind::Output, kMagnitude, kSetConstantForce);
    Report report = blank(HidReportKind::Output, field);
    set(report, HidReportKind::Output, kBlockIndex, kSetConstantForce, block_[static_cast<std::size_t>(axis)]);
    writeField(field, value, report);
    return port.write(report);
  }
  bool operate(HidPort& port, int axis, HidUsage what) const {
    const HidField* field = layout_.find(HidReportKind::Output, what, kOperation);
    if (field == nullptr) return true;
    Report report = blank(HidReportKind::Output, *field);
    set(report, HidReportKind::Output, kBlockIndex, kOperation, block_[static_cast<std::size_t>(axis)]);
    writeUsage(*field, what, report);
    set(report, HidReportKind::Output, kLoopCount, kOperation, 1);
    return port.write(report);
  }

  HidLayout layout_;
  std::int32_t full_ = 0;
  int axes_ = 0;
  std::array<std::int32_t, 2> block_{}, told_{};
};

std::uint8_t signedByte(double share) noexcept {
  return static_cast<std::uint8_t>(static_cast<std::int8_t>(std::lround(127 * std::clamp(share, -1.0, 1.0))));
}

class G940Force final : public StickForce {
 public:
  int axes() const override { return 2; }
  std::string start(HidPort& port) override { return tell(port, 0, 0) ? "" : "it takes no force report"; }
  bool tell(HidPort& port, double x, double y) noexcept override {
    std::array<std::uint8_t, 64> report{};  // with the leading number, 0
    report[1] = 0x51;
    report[2] = signedByte(-x);
    report[32] = signedByte(-y);
    return port.write(report);
  }
  void stop(HidPort& port) noexcept override { tell(port, 0, 0); }
};

class WheelForce final : public StickForce {
 public:
  int axes() const override { return 1; }
  std::string start(HidPort& port) override { return tell(port, 0, 0) ? "" : "it takes no force report"; }
  bool tell(HidPort& port, double x, double) noexcept override {
    const auto level = static_cast<std::uint8_t>(std::clamp(0x80 + static_cast<int>(std::lround(127 * x)), 0, 255));
    const std::array<std::uint8_t, 8> report{0, 0x11, 0x08, level, 0x80, 0, 0, 0};
    return port.write(report);
  }
  void stop(HidPort& port) noexcept override {
    tell(port, 0, 0);
    const std::array<std::uint8_t, 8> off{0, 0x13, 0, 0, 0, 0, 0, 0};
    port.write(off);
  }
};

}  // namespace

std::unique_ptr<StickForce> makePidForce(const HidLayout& layout) { return std::make_unique<PidForce>(layout); }
std::unique_ptr<StickForce> makeG940Force() { return std::make_unique<G940Force>(); }
std::unique_ptr<StickForce> makeWheelForce() { return std::make_unique<WheelForce>(); }

}  // namespace reachlab::devices
