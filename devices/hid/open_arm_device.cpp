#include "devices/hid/open_arm_device.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/device_options.h"
#include "base/error.h"
#include "devices/driver/drivers.h"
#include "devices/hid/report_descriptor.h"
#include "devices/mapping/towards_right_up.h"

namespace reachlab::devices {
namespace {

constexpr int kReportMs = 10;     // the firmware's turn; longer, and it is asked again
constexpr int kMostDrained = 64;  // a device that never stops sending is answered all the same

}  // namespace

std::string firmwareFault(std::size_t reportBytes) {
  if (reportBytes >= kArmPayloadBytes) return {};
  return fmt::format(
      "its firmware is too old: it sends reports of {} bytes, and {} are needed; put a newer one on it (github.com/forsslund/haptikfabrikenapi, "
      "folder firmware)",
      reportBytes, kArmPayloadBytes);
}

OpenArm::OpenArm(const Options& options, const std::string& serial, OpenPort open)
    : options_(options), serial_(serial), open_(std::move(open)), port_(open_()) {
  options_.reportBytes = std::min(options_.reportBytes, bytes_.size());
  if (options_.calibrateAtStart) setEncoders();
}

std::string OpenArm::lossText() const { return whole_ || shortReport_ == 0 ? std::string() : firmwareFault(shortReport_); }

haptics::DeviceInfo OpenArm::info() const {
  return {.name = fmt::format("{}{}", options_.model->name, serial_.empty() ? "" : " " + serial_),
          .version = "open arm over HID",
          .maxForce = options_.model->maxForce,
          .rendersForce = true,
          .workspaceRadius = 0.1,
          .secondPath = PolledDevice::describeStale() + "; its firmware switches off after 0.5 s"};
}

bool OpenArm::send(const ArmCommand& command) {
  std::array<std::uint8_t, 65> bytes{};
  const std::span<std::uint8_t> used(bytes.data(), std::min(options_.commandBytes, bytes.size()));
  encodeArmCommand(command, used);
  return port_->write(used);
}

bool OpenArm::setEncoders() {
  ArmCommand command;
  command.kind = ArmCommand::SetEncoders;
  for (std::size_t i = 0; i < 3; ++i) command.encoders[i] = static_cast<std::int16_t>(options_.model->calibrationCounts[i]);
  for (UnwrappedCount& count : counts_) count.reset();
  return send(command);
}

// The newest whole report; what has piled up meanwhile is passed over. As HidPort::read, but garbage counts as nothing.
int OpenArm::readNewest() {
  int newest = 0;
  std::array<std::uint8_t, 64> waiting{};
  for (int i = 0; i < kMostDrained; ++i) {
    const int got = port_->read({waiting.data(), options_.reportBytes}, newest == 0 ? kReportMs : 0);
    if (got < 0) return -1;
    if (got == 0) break;
    if (static_cast<std::size_t>(got) != options_.reportBytes) {
      shortReport_ = static_cast<std::size_t>(got);
      continue;
    }
    whole_ = true;
    std::copy_n(waiting.begin(), got, bytes_.begin());
    newest = got;
  }
  return newest;
}

Exchange OpenArm::exchange(ForceSource& source, haptics::DeviceSample& sample) {
  if (!port_) return Exchange::Lost;
  const int got = readNewest();
  if (got < 0) return Exchange::Lost;
  if (got == 0) return send({}) ? Exchange::Nothing : Exchange::Lost;
  const auto report = decodeArmReport({bytes_.data(), static_cast<std::size_t>(got)});
  if (!report) return Exchange::Nothing;
  if (report->calibrationButton) {
    if (!setEncoders()) return Exchange::Lost;
    return Exchange::Nothing;  // this report's encoders are those of before
  }
  std::array<double, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i) counts[i] = counts_[i].take(report->encoders[i]);
  angles_ = jointAngles(*options_.model, counts);
  ArmCommand command;
  command.currents = motorCurrents(*options_.model, angles_, toTowardsRightUp(source.newest()), options_.maxCurrent);
  if (!send(command)) return Exchange::Lost;
  sample.position = fromTowardsRightUp(handlePlace(*options_.model, angles_));
  sample.hasVelocity = false;
  sample.buttons = report->button ? 1 : 0;
  return Exchange::Report;
}

bool OpenArm::reopen() {
  port_.reset();
  port_ = open_();
  for (UnwrappedCount& count : counts_) count.reset();
  return true;
}

void OpenArm::close() noexcept {
  if (!port_) return;
  port_->read({bytes_.data(), options_.reportBytes}, kReportMs);  // its turn, then ours
  send({});
  port_.reset();
}

std::string OpenArm::calibrationHint() const {
  return fmt::format("hold the arm in its calibration pose (encoders {}, {}, {})", options_.model->calibrationCounts[0],
                     options_.model->calibrationCounts[1], options_.model->calibrationCounts[2]);
}

std::string OpenArm::calibrate() {
  if (!port_) return "it is not connected";
  return setEncoders() ? "" : "it does not take the calibration";
}

namespace {

constexpr std::uint16_t kTeensyVendor = 0x16C0, kTeensyProduct = 0x0486, kMbedVendor = 0x1234, kMbedProduct = 0x0006;
constexpr const char* kNoArm = "no WoodenHaptics or Polhem arm (USB 16c0:0486 or 1234:0006) is connected";

std::vector<HidInterface> findArms() {
  std::vector<HidInterface> found = findHid(kTeensyVendor, kTeensyProduct);
  const std::vector<HidInterface> older = findHid(kMbedVendor, kMbedProduct);
  found.insert(found.end(), older.begin(), older.end());
  return found;
}

// By its report descriptor, so that nothing is opened for it. Empty: nothing is wrong, or the first reports will tell.
std::string firmwareFaultOf(const HidInterface& arm) {
  const std::size_t bytes = inputReportBytes(readSystemDescriptor(arm.path));
  return bytes > 0 ? firmwareFault(bytes) : std::string();
}

HidInterface chooseArm(const std::string& key, const std::string& words) {
  const std::vector<HidInterface> arms = findArms();
  if (arms.empty()) throw ResourceError(fmt::format("{}: {}", words, kNoArm));
  if (const HidInterface* arm = chooseHid(arms, key)) return *arm;
  std::string there;
  for (const HidInterface& arm : arms) there += (there.empty() ? "" : ", ") + arm.key();
  throw ResourceError(fmt::format("{}: not connected; there is: {}", words, there));
}

OpenArm::Options optionsFor(const HidInterface& arm) {
  OpenArm::Options options;
  options.model = findArmModel("woodenhaptics_v2015");
  if (arm.vendor == kMbedVendor) options.commandBytes = 1 + kArmPayloadBytes, options.reportBytes = kArmPayloadBytes;
  return options;
}

std::unique_ptr<haptics::HapticDevice> makeArm(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  std::vector<std::string> names;
  for (const ArmModel& model : armModels()) names.emplace_back(model.name);
  const std::string model = options.word("model", names);
  const double maxCurrent = options.number("max-current", 2, 0.01, 6);
  const bool calibrate = options.word("calibrate", {"no", "start"}) == "start";
  options.done();
  const HidInterface arm = chooseArm(options.plain(), request.words());
  if (const std::string fault = firmwareFaultOf(arm); !fault.empty()) throw ResourceError(fmt::format("{}: {}", request.words(), fault));
  OpenArm::Options chosen = optionsFor(arm);
  chosen.model = findArmModel(model);
  chosen.maxCurrent = maxCurrent;
  chosen.calibrateAtStart = calibrate;
  const auto open = [key = arm.key(), words = request.words()] {
    try {
      return std::make_unique<HidPort>(chooseArm(key, words));
    } catch (const ResourceError& error) {
      throw ResourceError(fmt::format("{}: {}", words, error.what()));
    }
  };
  return std::make_unique<PolledDevice>(std::make_shared<OpenArm>(chosen, arm.serial, open));
}

std::vector<FoundDevice> findArmDevices(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  for (const HidInterface& arm : findArms()) {
    const std::string closed = whyNotOpen(arm);
    const haptics::DeviceInfo info{.name = arm.title.empty() ? self.description : arm.maker + (arm.maker.empty() ? "" : " ") + arm.title,
                                   .maxForce = optionsFor(arm).model->maxForce,
                                   .rendersForce = true};
    found.push_back(presentDevice(self, arm.key(), info, closed.empty() ? firmwareFaultOf(arm) : closed));
  }
  return rowsOr(std::move(found), self, kNoArm);
}

}  // namespace

DeviceDriver hidDriver() {
  return {"hid", "hid[:SERIAL][,model=NAME,max-current=A,calibrate=start]", "WoodenHaptics and Polhem arms over USB HID", findArmDevices,
          makeArm};
}

}  // namespace reachlab::devices
