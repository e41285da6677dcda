#include "devices/serial/polhem_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/device_options.h"
#include "base/error.h"
#include "devices/driver/drivers.h"
#include "devices/mapping/towards_right_up.h"
#include "devices/serial/polhem_line.h"
#include "devices/serial/serial_port.h"

namespace reachlab::devices {
namespace {

constexpr std::int64_t kPolhemAskAgainNs = 10'000'000;
constexpr int kMostUnanswered = 50;  // half a second: its firmware's own watchdog has then switched it off as well

}  // namespace

PolhemSerial::PolhemSerial(std::string name, OpenLink open) : AskedDevice(std::move(open), kPolhemAskAgainNs), name_(std::move(name)) {
  connect();
}

haptics::DeviceInfo PolhemSerial::info() const {
  return {.name = name_,
          .version = "Polhem v3, serial line",
          .maxForce = 5,
          .rendersForce = true,
          .workspaceRadius = 0.15,
          .secondPath = PolledDevice::describeStale() + "; its firmware switches off after 0.5 s"};
}

std::string PolhemSerial::commandOf(const Vec3& force) const { return polhemForceLine(toTowardsRightUp(force)); }

Exchange PolhemSerial::take(const std::string* message, haptics::DeviceSample& sample) {
  const auto state = message != nullptr ? readPolhemLine(*message) : std::nullopt;
  if (!state) return ++unanswered_ >= kMostUnanswered ? Exchange::Lost : Exchange::Nothing;
  noteAnswer();
  unanswered_ = 0;
  sample.position = fromTowardsRightUp(state->place);
  sample.hasVelocity = false;
  sample.buttons = state->info != 0 ? 1 : 0;
  return Exchange::Report;
}

namespace {

// What the system says of the USB device behind a terminal.
std::string vendorOf(const std::filesystem::path& terminal) {
  std::ifstream in("/sys/class/tty/" + terminal.filename().string() + "/device/../idVendor");
  std::string vendor;
  in >> vendor;
  return vendor;
}

std::vector<std::string> findTerminals() {
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/dev", error))
    if (entry.path().filename().string().starts_with("ttyACM") && vendorOf(entry.path()) == "16c0") found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::unique_ptr<haptics::HapticDevice> makePolhem(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  options.done();
  std::string path = options.plain();
  if (path.empty()) {
    const auto there = findTerminals();
    if (there.empty())
      throw ResourceError(fmt::format("{}: no Polhem v3 (a serial line ttyACM of USB vendor 16c0) is connected", request.words()));
    path = there.front();
  }
  try {
    return std::make_unique<PolledDevice>(std::make_shared<PolhemSerial>("Polhem v3 " + path, [path] { return openSerial(path); }));
  } catch (const ResourceError& error) {
    throw ResourceError(fmt::format("{}: {}", request.words(), error.what()));
  }
}

std::vector<FoundDevice> findPolhem(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  for (const std::string& path : findTerminals())
    found.push_back(presentDevice(self, path, {.name = "Polhem v3", .maxForce = 5, .rendersForce = true}));
  return rowsOr(std::move(found), self, "no serial line ttyACM of USB vendor 16c0 is there; another line is named: polhem:/dev/ttyACM0");
}

}  // namespace

DeviceDriver polhemDriver() { return {"polhem", "polhem[:PATH]", "Polhem v3 over its serial line", findPolhem, makePolhem}; }

}  // namespace reachlab::devices
