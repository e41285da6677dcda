#include "devices/mapping/guarded_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "base/as_number.h"
#include "base/fault.h"

namespace reachlab::devices {
namespace {

constexpr double kGravity = 9.80665;  // [m/s^2]

/// Passes everything on; places and velocities into the world, forces out of it.
class GuardedDevice final : public haptics::HapticDevice {
 public:
  GuardedDevice(std::unique_ptr<haptics::HapticDevice> device, const HandSettings& options)
      : device_(std::move(device)), options_(options), rows_(directions(options.mapping)) {
    if (const haptics::DeviceInfo info = device_->info(); info.steered) fixed_ = info.workspaceCentre;
  }

  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info = device_->info();
    const Mapping& m = options_.mapping;
    info.workspaceRadius *= m.scale;
    info.workspaceCentre = placed(info.workspaceCentre);
    info.resolution *= m.scale;
    // Forces are not scaled: in the world the device moves m.scale times as fast under the same force.
    info.scale = m.scale;
    info.apparentMass /= m.scale;
    info.viscosity /= m.scale;
    info.speedLimit = options_.speedLimit.value_or(info.speedLimit * m.scale);
    if (options_.mapped) info.mapping = toJson(m);
    haptics::GuardSettings& guards = info.guards;
    guards.wallStiffness /= m.scale;
    guards.wallDamping /= m.scale;
    if (options_.wall) {
      guards.wallCentre = info.workspaceCentre;
      guards.wallRadius = *options_.wall > 0 ? *options_.wall : info.workspaceRadius;
    }
    if (options_.stylusMass) info.stylusMass = *options_.stylusMass;
    if (options_.stylusMass) guards.compensation = turned({0, kGravity * info.stylusMass, 0});  // up is up at the device
    guards.passivityControl = options_.passivityControl;
    return info;
  }

  haptics::DeviceSample read() noexcept override {
    haptics::DeviceSample sample = device_->read();
    const Mapping& m = options_.mapping;
    sample.position = placed(sample.position);
    sample.velocity = m.scale * turned(sample.velocity);
    if (options_.deadManButton > 0 && (sample.buttons >> (options_.deadManButton - 1) & 1u) == 0) sample.released = true;
    return sample;
  }
  void write(const Vec3& force) noexcept override {
    device_->write(force.x * rows_[0] + force.y * rows_[1] + force.z * rows_[2]);  // the transpose
  }

  void prepareTrial(int index, int scene = 0) override { device_->prepareTrial(index, scene); }
  void cue(haptics::Cue cue) noexcept override { device_->cue(cue); }
  void see(std::span<const dynamics::MassState> masses) noexcept override { device_->see(masses); }
  haptics::DeviceHealth health() const noexcept override { return device_->health(); }
  std::string healthText() const override { return device_->healthText(); }
  std::string calibrationHint() const override { return device_->calibrationHint(); }
  void calibrate() override { device_->calibrate(); }
  bool stopForce() noexcept override { return device_->stopForce(); }
  void startClock(ClockTick tick, void* context) override { device_->startClock(tick, context); }
  void stopClock() noexcept override { device_->stopClock(); }

 private:
  Vec3 placed(const Vec3& place) const noexcept {
    return fixed_ + options_.mapping.offset + options_.mapping.scale * turned(place - fixed_);
  }
  Vec3 turned(const Vec3& v) const noexcept { return {dot(rows_[0], v), dot(rows_[1], v), dot(rows_[2], v)}; }

  std::unique_ptr<haptics::HapticDevice> device_;
  HandSettings options_;
  std::array<Vec3, 3> rows_;
  Vec3 fixed_;  // [m] what scale, turn and mirror leave where it is
};

// "0.1/0/-0.05"
std::optional<Vec3> takeVector(DeviceOptions& options, const std::string& key, double most) {
  const auto text = options.take(key);
  if (!text) return std::nullopt;
  std::vector<double> parts;
  std::istringstream in(*text + '/');  // an empty last part counts
  for (std::string part; std::getline(in, part, '/');) parts.push_back(asNumber<double>(part).value_or(NAN));
  if (parts.size() != 3 || !std::all_of(parts.begin(), parts.end(), [&](double x) { return std::abs(x) <= most; }))
    throw FaultError(Fault{"device", fmt::format("{}={}", key, *text), fmt::format("X/Y/Z, each within {}", most)});
  return Vec3{parts[0], parts[1], parts[2]};
}

}  // namespace

HandSettings takeHandSettings(DeviceOptions& options) {
  HandSettings hand;
  if (const auto file = options.take("mapping")) hand.mapping = readMapping(*file), hand.mapped = true;
  const double scale = options.number("scale", -1, 0.01, 100);
  if (scale > 0) hand.mapping.scale = scale, hand.mapped = true;
  if (const auto offset = takeVector(options, "offset", 10)) hand.mapping.offset = *offset, hand.mapped = true;
  if (const auto degrees = takeVector(options, "rotation", 360))
    hand.mapping.rotation = std::numbers::pi / 180 * *degrees, hand.mapped = true;
  if (const auto mirror = options.take("mirror")) {
    if (*mirror != "x" && *mirror != "no") throw FaultError(Fault{"device", "mirror=" + *mirror, "no, x"});
    hand.mapping.mirrorX = *mirror == "x";
    hand.mapped = true;
  }
  if (const auto wall = options.take("wall")) {
    const double radius = asNumber<double>(*wall).value_or(0);
    const bool number = radius > 0 && radius <= 10;
    if (*wall != "yes" && *wall != "no" && !number) throw FaultError(Fault{"device", "wall=" + *wall, "yes, no or a radius up to 10 m"});
    if (*wall != "no") hand.wall = number ? radius : 0;
  }
  const double speed = options.number("speed-limit", -1, 0.01, 20);
  if (speed > 0) hand.speedLimit = speed;
  const double mass = options.number("stylus-mass", -1, 0, 2);
  if (mass >= 0) hand.stylusMass = mass;
  hand.passivityControl = options.word("passivity", {"observe", "control"}) == "control";
  const double button = options.number("dead-man-button", 0, 1, 32);
  hand.deadManButton = static_cast<int>(button);
  if (button != hand.deadManButton)
    throw FaultError(Fault{"device", fmt::format("dead-man-button={}", button), "a button's number, 1 to 32"});
  return hand;
}

std::unique_ptr<haptics::HapticDevice> guardDevice(std::unique_ptr<haptics::HapticDevice> device, const HandSettings& options) {
  if (!options.any()) return device;
  const haptics::DeviceInfo info = device->info();
  if (options.wall && *options.wall == 0 && !(info.workspaceRadius > 0))
    throw FaultError(Fault{"device", fmt::format("wall=yes: the workspace of {} is not known", info.name), "wall=RADIUS_M"});
  for (const auto& [key, asked] : {std::pair{"wall", options.wall.has_value()},
                                   {"speed-limit", options.speedLimit.has_value()},
                                   {"stylus-mass", options.stylusMass.has_value()},
                                   {"passivity", options.passivityControl},
                                   {"dead-man-button", options.deadManButton > 0}})
    if (asked && !info.rendersForce)
      throw FaultError(Fault{"device", fmt::format("{}: {} renders no force", key, info.name), "a force device"});
  if (options.deadManButton > 0 && info.virtualHand)
    throw FaultError(
        Fault{"device", fmt::format("dead-man-button: no hand presses a button of {}", info.name), "a force device that a person holds"});
  return std::make_unique<GuardedDevice>(std::move(device), options);
}

}  // namespace reachlab::devices
