#include "devices/hid/stick_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/fault.h"
#include "devices/driver/drivers.h"
#include "devices/driver/options.h"

namespace reachlab::devices {
namespace {

constexpr HidUsage kX = hidUsage(0x01, 0x30), kY = hidUsage(0x01, 0x31), kSteering = hidUsage(0x02, 0xC8), kButtonPage = hidUsage(0x09, 0);
constexpr int kWaitMs = 1;
constexpr int kMostGarbled = 20;  // reports in a row that are none of its own

const HidField* axisOf(const HidLayout& layout, std::initializer_list<HidUsage> usages) {
  for (const HidUsage usage : usages)
    if (const HidField* field = layout.find(HidReportKind::Input, usage); field != nullptr && !field->array && field->most > field->least)
      return field;
  return nullptr;
}

double shareOf(const HidField& field, std::int32_t value) noexcept {
  const double middle = (static_cast<double>(field.least) + field.most) / 2, half = (static_cast<double>(field.most) - field.least) / 2;
  return std::clamp((value - middle) / half, -1.0, 1.0);
}

}  // namespace

StickDevice::StickDevice(const Options& options, std::string name, const HidLayout& layout, std::unique_ptr<StickForce> force,
                         OpenPort open)
    : options_(options), name_(std::move(name)), layout_(layout), x_(axisOf(layout_, {kX, kSteering})), y_(axisOf(layout_, {kY})),
      force_(std::move(force)), open_(std::move(open)) {
  if (x_ == nullptr) throw FaultError(Fault{"device", name_ + ": its report descriptor has no axis X"});
  this->open();
}

void StickDevice::open() {
  port_ = open_();
  garbled_ = 0;
  if (!(options_.fullForce > 0)) return;
  if (const std::string fault = force_->start(*port_); !fault.empty()) {
    port_.reset();
    throw ResourceError(fmt::format("{}: {}", name_, fault));
  }
}

haptics::DeviceInfo StickDevice::info() const {
  haptics::DeviceInfo info;
  info.name = name_;
  info.version = "HID";
  info.maxForce = options_.fullForce;
  info.rendersForce = options_.fullForce > 0;
  info.degreesOfFreedom = force_->axes();
  info.workspaceRadius = options_.travel;
  info.resolution = 2 * options_.travel / std::max(1.0, static_cast<double>(x_->most) - x_->least);
  info.secondPath = "the I/O thread tells it zero when the tick leaves no new force for 20 ms";
  return info;
}

bool StickDevice::take(std::span<const std::uint8_t> report) noexcept {
  const auto x = readField(layout_, *x_, report);
  const auto y = y_ != nullptr ? readField(layout_, *y_, report) : std::optional<std::int32_t>();
  if (x) place_.x = options_.travel * shareOf(*x_, *x);
  if (y) place_.z = options_.travel * shareOf(*y_, *y);
  if (x) {
    buttons_ = 0;
    for (const HidField& field : layout_.fields) {
      if (field.kind != HidReportKind::Input || field.array || (field.usages.front() & 0xFFFF0000u) != kButtonPage) continue;
      const std::uint32_t number = field.usages.front() & 0xFFFF;
      const auto pressed = readField(layout_, field, report);
      if (number >= 1 && number <= 32 && pressed.value_or(0) != 0) buttons_ |= 1u << (number - 1);
    }
  }
  return x.has_value() || y.has_value();
}

Exchange StickDevice::exchange(ForceSource& source, haptics::DeviceSample& sample) {
  if (!port_) return Exchange::Lost;
  std::array<std::uint8_t, 64> report{};
  constexpr int kMostDrained = 64;
  for (int i = 0; i < kMostDrained; ++i) {
    const int got = port_->read(report, i == 0 ? kWaitMs : 0);
    if (got < 0) return Exchange::Lost;
    if (got == 0) break;
    if (take({report.data(), static_cast<std::size_t>(got)})) garbled_ = 0;
    else if (++garbled_ >= kMostGarbled) return Exchange::Lost;
  }
  if (options_.fullForce > 0) {
    const double unit = (options_.reversed ? -1 : 1) / options_.fullForce;
    const Vec3 force = source.newest();
    if (!force_->tell(*port_, unit * force.x, unit * force.z)) return Exchange::Lost;
  }
  sample.position = place_;
  sample.hasVelocity = false;
  sample.buttons = buttons_;
  return Exchange::Report;
}

bool StickDevice::reopen() {
  std::unique_ptr<HidPort> old = std::move(port_);
  try {
    open();
    return true;
  } catch (const ResourceError&) {
    port_ = std::move(old);  // by which it can perhaps still be told zero
    return false;
  }
}

void StickDevice::close() noexcept {
  if (!port_) return;
  if (options_.fullForce > 0) force_->stop(*port_);
  port_.reset();
}

namespace {

constexpr std::uint16_t kLogitech = 0x046D, kG940 = 0xC287;

bool isWheel(const HidInterface& at) {
  constexpr std::uint16_t wheels[] = {0xC24F, 0xC294, 0xC298, 0xC299, 0xC29A, 0xC29B};  // G29, DF, DFP, G25, DFGT, G27
  return at.vendor == kLogitech && std::find(std::begin(wheels), std::end(wheels), at.product) != std::end(wheels);
}

struct FoundStick {
  HidInterface interface;
  HidLayout layout;
  std::unique_ptr<StickForce> force;
};

// A stick that can be felt: PID by its descriptor, or one of Logitech's that are known. Each interface once.
std::vector<FoundStick> findSticks() {
  std::vector<FoundStick> found;
  std::string last;
  for (const HidInterface& at : findHid()) {
    if (std::exchange(last, at.path) == at.path) continue;
    try {
      const HidLayout layout = parseReportDescriptor(readSystemDescriptor(at.path));
      if (axisOf(layout, {kX, kSteering}) == nullptr) continue;
      if (at.vendor == kLogitech && at.product == kG940) found.push_back({at, layout, makeG940Force()});
      else if (isWheel(at)) found.push_back({at, layout, makeWheelForce()});
      else found.push_back({at, layout, makePidForce(layout)});
    } catch (const FaultError&) {  // not a stick that can be felt
    }
  }
  return found;
}

constexpr const char* kNone = "no force-feedback joystick or wheel (HID PID, Logitech G940, G25, G27, G29, DFGT) is connected";

std::unique_ptr<haptics::HapticDevice> makeStick(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  StickDevice::Options chosen;
  chosen.travel = options.number("travel", chosen.travel, 0.005, 1);
  const double force = options.number("full-force", 0, -50, 50);
  chosen.fullForce = std::abs(force);
  chosen.reversed = force < 0;
  options.done();
  for (FoundStick& stick : findSticks()) {
    if (!options.plain().empty() && stick.interface.key() != options.plain() && stick.interface.path != options.plain()) continue;
    const auto open = [at = stick.interface, words = request.words()] {
      for (const HidInterface& now : findHid(at.vendor, at.product))
        if (now.serial == at.serial) return openHid(now);
      throw ResourceError(words + ": is not connected any more");
    };
    const std::string name = stick.interface.title.empty() ? "force-feedback stick" : stick.interface.title;
    return std::make_unique<PolledDevice>(std::make_shared<StickDevice>(chosen, name, stick.layout, std::move(stick.force), open));
  }
  throw ResourceError(fmt::format("{}: {}", request.words(), kNone));
}

std::vector<FoundDevice> findStickDevices(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  for (const FoundStick& stick : findSticks()) {
    haptics::DeviceInfo info;
    info.name = stick.interface.title + " (its force needs full-force=N, measured)";
    info.degreesOfFreedom = stick.force->axes();
    found.push_back(presentDevice(self, self.name + ":" + stick.interface.key(), info));
    found.back().whyNot = whyNotOpen(stick.interface);
    found.back().present = found.back().whyNot.empty();
  }
  if (found.empty()) return {absentDevice(self, kNone)};
  return found;
}

}  // namespace

DeviceDriver stickDriver() {
  return {"stick",
          "stick[:SERIAL][,full-force=N,travel=M]",
          "force-feedback joystick or wheel (HID PID, Logitech): planar tasks",
          false,
          findStickDevices,
          makeStick};
}

}  // namespace reachlab::devices
