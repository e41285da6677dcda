#include "devices/virtual/virtual_device.h"

#include <fmt/format.h>

#include <cmath>
#include <ranges>

#include "base/device_options.h"
#include "base/fault.h"
#include "base/math/elementary.h"
#include "base/ticks.h"
#include "devices/driver/drivers.h"
#include "sim/subjects/plans/simulated_hand.h"

namespace reachlab::devices {
namespace {

constexpr int kSubsteps = 10;
constexpr double kStep = kTickSeconds / kSubsteps;
constexpr double kCreep = 1e-3;  // [m/s] v0: below it Coulomb friction is viscous, so that a resting handle does not chatter

double rounded(double value, double step) noexcept { return std::round(value / step) * step; }

}  // namespace

VirtualDevice::VirtualDevice(const DeviceModel& model, const Options& options, std::unique_ptr<haptics::HapticDevice> hand)
    : model_(model), options_(options), hand_(std::move(hand)) {}

haptics::DeviceInfo VirtualDevice::info() const {
  haptics::DeviceInfo info = hand_->info();
  info.name = fmt::format("virtual {}", model_.title);
  info.version = "1";
  info.maxForce = model_.maxForce;
  info.maxContinuousForce = model_.continuousForce;
  info.rendersForce = true;
  info.workspaceRadius = model_.workspaceRadius;
  info.apparentMass = model_.mass;
  info.coulombFriction = model_.friction;
  info.viscosity = model_.viscosity;
  info.resolution = options_.quantised ? model_.resolution : 0;
  info.secondPath = "none is needed: it is simulated";
  return info;
}

void VirtualDevice::cue(haptics::Cue cue) noexcept {
  hand_->cue(cue);
  if (cue != haptics::Cue::Place) return;
  placed_ = false;
  forces_.fill({});
}

void VirtualDevice::write(const Vec3& force) noexcept {
  Vec3 felt = isFinite(force) ? force : Vec3{};
  if (const double size = norm(felt); size > model_.maxForce) felt = model_.maxForce / size * felt;
  at_ = (at_ + 1) % kMostDelay;
  forces_[static_cast<std::size_t>(at_)] = felt;
}

void VirtualDevice::advanceTick(const Vec3& from, const Vec3& to) noexcept {
  const Vec3 force = forces_[static_cast<std::size_t>((at_ - options_.delayTicks + kMostDelay) % kMostDelay)];
  const HandImpedance& hand = options_.hand;
  const double mass = model_.mass + hand.mass;
  const Vec3 speed = (to - from) / kTickSeconds, push = mass / kTickSeconds * (speed - meantSpeed_);  // m p''
  const auto friction = [&](double v) { return model_.viscosity * v + model_.friction * elementary::tanh(v / kCreep); };
  for (int i = 1; i <= kSubsteps; ++i) {
    const Vec3 meant = from + (static_cast<double>(i) / kSubsteps) * (to - from);
    const Vec3 drag{friction(speed_.x), friction(speed_.y), friction(speed_.z)};
    const Vec3 total = force + push + hand.stiffness * (meant - place_) + hand.damping * (speed - speed_) - drag;
    speed_ += (kStep / mass) * total;
    place_ += kStep * speed_;
  }
  meantSpeed_ = speed;
}

haptics::DeviceSample VirtualDevice::read() noexcept {
  const haptics::DeviceSample meant = hand_->read();
  if (!placed_) {
    placed_ = true;
    place_ = meant_ = meant.position;
    speed_ = meantSpeed_ = {};
  } else {
    advanceTick(meant_, meant.position);
    meant_ = meant.position;
  }
  haptics::DeviceSample sample;
  sample.position = place_;
  if (options_.quantised)
    sample.position = {rounded(place_.x, model_.resolution), rounded(place_.y, model_.resolution), rounded(place_.z, model_.resolution)};
  sample.reports = ++reports_;
  sample.valid = meant.valid;
  sample.buttons = meant.buttons;
  return sample;
}

namespace {

// Stiffer than an arm is: for a person who has learned what the object does and meets it, which the plan does not. With these a rehearsal
// succeeds as often as the plan alone (docs/devices.md).
constexpr double kPractisedStiffness = 3000;  // [N/m]
constexpr double kPractisedDamping = 80;      // [N s/m]

std::unique_ptr<haptics::HapticDevice> makeVirtual(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  const DeviceModel* model = findDeviceModel(options.plain());
  if (model == nullptr)
    throw FaultError(Fault{
        "device", options.plain().empty() ? "is virtual, without a model" : "is virtual:" + options.plain() + ", which is no model",
        fmt::format("virtual:MODEL with MODEL one of {}", fmt::join(deviceModels() | std::views::transform(&DeviceModel::name), ", "))});
  VirtualDevice::Options chosen;
  chosen.hand.mass = options.number("arm-mass", chosen.hand.mass, 0, 50);
  chosen.hand.stiffness = options.number("arm-stiffness", kPractisedStiffness, 0, 1e5);
  chosen.hand.damping = options.number("arm-damping", kPractisedDamping, 0, 1e4);
  chosen.delayTicks = options.count("delay-ms", 0, 0, VirtualDevice::kMostDelay - 1);
  chosen.quantised = options.word("quantised", {"yes", "no"}) == "yes";
  const subjects::SubjectSpec subject = subjects::takeSubject(options);
  options.done();
  return std::make_unique<VirtualDevice>(*model, chosen, subjects::makeSimulatedHand(request.experiment, subject, request.seed));
}

std::vector<FoundDevice> findVirtual(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  for (const DeviceModel& model : deviceModels()) {
    FoundDevice row = alwaysThere(self).front();
    row.name = fmt::format("{}:{}", self.name, model.name);
    row.description = fmt::format("{} as a simulated body, held by a simulated hand", model.title);
    row.maxForce = model.maxForce;
    row.continuousForce = model.continuousForce;
    found.push_back(row);
  }
  return found;
}

}  // namespace

DeviceDriver virtualDriver() {
  return {"virtual",
          "virtual:MODEL[,arm-mass=KG,arm-stiffness=N_PER_M,arm-damping=N_S_PER_M,delay-ms=N,quantised=no,…]",
          "a force device as a simulated body, held by a simulated hand",
          findVirtual,
          makeVirtual,
          true};
}

}  // namespace reachlab::devices
