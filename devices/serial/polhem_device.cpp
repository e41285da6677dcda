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

constexpr int kAnswerMs = 10;
constexpr std::int64_t kAskAgainNs = 10'000'000;
constexpr int kMostUnanswered = 50;  // half a second: its firmware's own watchdog has then switched it off as well

}  // namespace

PolhemSerial::PolhemSerial(std::string name, OpenPort open) : name_(std::move(name)), open_(std::move(open)), port_(open_()) {}

haptics::DeviceInfo PolhemSerial::info() const {
  haptics::DeviceInfo info;
  info.name = name_;
  info.version = "Polhem v3, serial line";
  info.maxForce = 5;
  info.rendersForce = true;
  info.workspaceRadius = 0.15;
  info.secondPath = "the I/O thread tells it zero when the tick leaves no new force for 20 ms; its firmware switches off after 0.5 s";
  return info;
}

Exchange PolhemSerial::exchange(ForceSource& source, haptics::DeviceSample& sample) {
  if (!port_) return Exchange::Lost;
  if (!awaiting_ || source.now() - sentNs_ > kAskAgainNs) {
    if (!port_->send(polhemForceLine(toTowardsRightUp(source.newest())))) return Exchange::Lost;
    sentNs_ = source.now();
    awaiting_ = true;
  }
  std::string line, newer;
  const MessageLink::Got got = port_->receive(line, kAnswerMs);
  if (got == MessageLink::Got::Gone) return Exchange::Lost;
  constexpr int kMostDrained = 64;
  for (int i = 0; got == MessageLink::Got::Message && i < kMostDrained && port_->receive(newer, 0) == MessageLink::Got::Message; ++i)
    line.swap(newer);
  const auto state = got == MessageLink::Got::Message ? readPolhemLine(line) : std::nullopt;
  if (!state) return ++unanswered_ >= kMostUnanswered ? Exchange::Lost : Exchange::Nothing;
  awaiting_ = false;
  unanswered_ = 0;
  sample.position = fromTowardsRightUp(state->place);
  sample.hasVelocity = false;
  sample.buttons = state->info != 0 ? 1 : 0;
  return Exchange::Report;
}

bool PolhemSerial::reopen() {
  port_.reset();
  awaiting_ = false;
  unanswered_ = 0;
  port_ = open_();
  return true;
}

bool PolhemSerial::tellZero() noexcept {
  try {
    return !port_ || port_->send(polhemForceLine({}));
  } catch (const std::exception&) {  // no memory for a line: its firmware switches off
    return false;
  }
}

void PolhemSerial::close() noexcept {
  tellZero();
  port_.reset();
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
  for (const std::string& path : findTerminals()) {
    haptics::DeviceInfo info;
    info.name = "Polhem v3";
    info.maxForce = 5;
    info.rendersForce = true;
    found.push_back(presentDevice(self, path, info));
  }
  return rowsOr(std::move(found), self, "no serial line ttyACM of USB vendor 16c0 is there; another line is named: polhem:/dev/ttyACM0");
}

}  // namespace

DeviceDriver polhemDriver() { return {"polhem", "polhem[:PATH]", "Polhem v3 over its serial line", findPolhem, makePolhem}; }

}  // namespace reachlab::devices
