#include "devices/haply/haply_device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/device_options.h"
#include "base/error.h"
#include "devices/driver/drivers.h"
#include "devices/haply/web_socket_link.h"
#include "devices/virtual/device_model.h"

namespace reachlab::devices {
namespace {

constexpr std::int64_t kAskAgainNs = 50'000'000;  // an answer that did not come by then will not
constexpr int kUnaskedMs = 200, kFirstMs = 2000;
constexpr int kMostGarbled = 20;  // in a row, before it counts as lost
constexpr std::uint16_t kPort = 10001;

// Older services tell their state unasked, newer ones answer only.
std::string firstMessage(MessageLink& link) {
  std::string message;
  if (link.receive(message, kUnaskedMs) == MessageLink::Got::Message) return message;
  // One that does not care for profiles may still answer a message that asks for nothing.
  for (const std::string& greeting : {haplyGreeting(), std::string("{}")}) {
    link.send(greeting);
    if (link.receive(message, kFirstMs / 2) == MessageLink::Got::Message) return message;
  }
  throw ResourceError(link.fault().empty() ? fmt::format("the service does not answer within {} ms", kFirstMs) : link.fault());
}

}  // namespace

HaplyInverse3::HaplyInverse3(const Options& options, OpenLink open) : AskedDevice(std::move(open), kAskAgainNs), options_(options) {
  connect();
}

void HaplyInverse3::greet(MessageLink& link) {
  const std::string first = firstMessage(link);
  const HaplyService service = readHaplyService(first, options_.id);
  switch (readHaplyMessage(first, options_.id, state_, options_.grip)) {
    case HaplyAnswer::State: break;
    case HaplyAnswer::NotJson: throw ResourceError("what answers is no Inverse service (its first message is none of its protocol)");
    case HaplyAnswer::OtherVersion:
      throw ResourceError("the Inverse service speaks a protocol of another version (known: 3.1 to 3.5); update it");
    case HaplyAnswer::NoDevice:
      throw ResourceError(service.devices.empty() ? std::string("the Inverse service runs, but no Inverse3 is connected")
                                                  : fmt::format("not connected; there is: {}", fmt::join(service.devices, ", ")));
  }
  there_ = service.devices;
  const std::vector<std::string>& grips = service.grips;
  if (!options_.grip.empty() && std::find(grips.begin(), grips.end(), options_.grip) == grips.end())
    throw ResourceError(fmt::format("the Inverse service has no VerseGrip {}; there is: {}", options_.grip,
                                    grips.empty() ? "none" : fmt::format("{}", fmt::join(grips, ", "))));
  const DeviceModel& model = *findDeviceModel("inverse3");
  info_.name = "Haply Inverse3 " + state_.id;
  info_.version = "Inverse service, websocket" + (service.settings.empty() ? "" : "; " + service.settings);
  info_.maxForce = options_.maxForce > 0 ? options_.maxForce : model.maxForce;
  info_.maxContinuousForce = std::min(model.continuousForce, info_.maxForce);
  info_.rendersForce = true;
  info_.workspaceRadius = model.workspaceRadius;
  info_.apparentMass = model.mass;
  info_.coulombFriction = model.friction;
  info_.resolution = model.resolution;
  info_.secondPath = PolledDevice::describeStale();
  options_.id = state_.id;
  garbled_ = 0;
}

// The sum takes the sign off a zero.
std::string HaplyInverse3::commandOf(const Vec3& force) const { return haplyForceCommand(options_.id, worldToHaply(force) + Vec3{}); }

Exchange HaplyInverse3::take(const std::string* message, haptics::DeviceSample& sample) {
  if (message == nullptr) return Exchange::Nothing;
  noteAnswer();
  switch (readHaplyMessage(*message, options_.id, state_, options_.grip)) {
    case HaplyAnswer::State: break;
    case HaplyAnswer::NoDevice: return lose(fmt::format("the service has no Inverse3 {} any more", options_.id));
    case HaplyAnswer::NotJson:
    case HaplyAnswer::OtherVersion:
      if (++garbled_ >= kMostGarbled) return lose("the service's messages cannot be understood any more");
      return Exchange::Nothing;
  }
  garbled_ = 0;
  sample.position = haplyToWorld(state_.position);
  sample.hasVelocity = options_.deviceVelocity && state_.velocity.has_value();
  if (sample.hasVelocity) sample.velocity = haplyToWorld(*state_.velocity);
  sample.buttons = state_.buttons;
  return Exchange::Report;
}

namespace {

std::unique_ptr<haptics::HapticDevice> makeHaply(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  HaplyInverse3::Options chosen;
  chosen.id = options.plain();
  chosen.grip = options.take("grip").value_or("");
  chosen.maxForce = options.number("max-force", findDeviceModel("inverse3")->maxForce, 0.01, findDeviceModel("inverse3")->maxForce);
  chosen.deviceVelocity = options.word("velocity", {"estimated", "device"}) == "device";
  const auto port = static_cast<std::uint16_t>(options.number("port", kPort, 1, 65535));
  options.done();
  try {
    return std::make_unique<PolledDevice>(std::make_shared<HaplyInverse3>(chosen, [port] { return openWebSocket("127.0.0.1", port); }));
  } catch (const ResourceError& error) {
    throw ResourceError(fmt::format("{}: {}", request.words(), error.what()));
  }
}

std::vector<FoundDevice> findHaply(const DeviceDriver& self) {
  try {
    const HaplyInverse3 device({}, [] { return openWebSocket("127.0.0.1", kPort); });
    std::vector<FoundDevice> found;
    for (const std::string& id : device.there()) found.push_back(presentDevice(self, id, device.info()));
    return found;
  } catch (const ResourceError& error) {
    return {absentDevice(self, fmt::format("{}; is Haply's Inverse service running?", error.what()))};
  }
}

}  // namespace

DeviceDriver haplyDriver() {
  return {"haply", "haply[:ID][,max-force=N,grip=ID,velocity=device,port=N]",
          "Haply Inverse3 by its service on this machine (ws://127.0.0.1:10001)", findHaply, makeHaply};
}

}  // namespace reachlab::devices
