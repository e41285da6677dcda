#include "devices/vendor/force_dimension.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/device_options.h"
#include "base/fault.h"
#include "devices/driver/drivers.h"
#include "devices/io/polled_device.h"
#include "devices/mapping/towards_right_up.h"
#include "devices/vendor/force_dimension_api.h"
#include "devices/virtual/device_model.h"

/// omega, delta, sigma, lambda and the Falcon by the vendor's library. Its calls may wait, so an I/O thread makes them, at most 2 kHz.
namespace reachlab::devices {
namespace {

constexpr std::int64_t kPeriodNs = 500'000;
constexpr int kMostErrors = 20;  // in a row, before it counts as lost: some 10 ms

// Peak force where the library does not tell it [N], radius of the workspace [m]: those that CHAI3D drives each model with
// (chai3d/chai3d:src/devices/CDeltaDevices.cpp, read).
struct Model {
  int type;
  double maxForce, radius;
};
constexpr Model omega(int type) { return {type, kOmegaForce, kOmegaRadius}; }
constexpr Model kKnownModels[] = {{63, 20, 0.15}, omega(33),  omega(34),  omega(36),    omega(35),
                                  omega(37),      omega(104), omega(105), {60, 8, 0.04}};
constexpr double kUnknownForce = 8, kUnknownRadius = 0.04;  // of the others, whatever they are: the least of these

class ForceDimension final : public Transport {
 public:
  ForceDimension(int index, std::string words, bool deviceVelocity)
      : dhd_(dhd::api()), id_(static_cast<char>(index)), words_(std::move(words)), deviceVelocity_(deviceVelocity) {
    open();
  }
  ~ForceDimension() override { shut(); }

  haptics::DeviceInfo info() const override { return info_; }
  std::int64_t period() const override { return kPeriodNs; }

  Exchange exchange(ForceSource& source, haptics::DeviceSample& sample) override {
    if (mustEnable(source.now()) && dhd_.enableForce(1, id_) < 0) {
      cut_.store(true, std::memory_order_release);  // tried again in the next exchange
      return fault();
    }
    Vec3 place, velocity;
    const int said = dhd_.getPosition(&place.x, &place.y, &place.z, id_);
    bool fine = said >= 0;
    if (fine && deviceVelocity_) fine = dhd_.getLinearVelocity(&velocity.x, &velocity.y, &velocity.z, id_) >= 0;
    const Vec3 force = toTowardsRightUp(source.newest());
    fine = (dhd_.setForce(force.x, force.y, force.z, id_) >= 0) && fine;
    if (!fine) return fault();
    errors_ = 0;
    if (said == dhd::kTimeGuard) return Exchange::Nothing;  // the sample of before once more
    sample.position = fromTowardsRightUp(place);
    sample.velocity = fromTowardsRightUp(velocity);
    sample.hasVelocity = deviceVelocity_;
    sample.buttons = dhd_.getButtonMask != nullptr ? dhd_.getButtonMask(id_) : 0;
    return Exchange::Report;
  }

  bool tellZero() noexcept override { return !isOpen_ || dhd_.setForce(0, 0, 0, id_) >= 0; }

  // While the I/O thread's call hangs. The next exchange switches the forces on again, with the zero that a lost hand gets.
  bool stopForce() noexcept override {
    const bool told = dhd_.enableForce(0, id_) >= 0;
    cut_.store(true, std::memory_order_release);
    return told;
  }

  bool reopen() override {
    shut();
    open();
    return true;
  }

  void close() noexcept override { shut(); }

 private:
  void open() {
    if (dhd_.openId(id_) < 0) throw ResourceError(fmt::format("{}: {}: {}", words_, dhd_.library.name(), dhd_.lastError()));
    isOpen_ = true;
    if (dhd_.enableForce(1, id_) < 0) {
      const std::string said = dhd_.lastError();
      shut();
      throw ResourceError(fmt::format("{}: its forces cannot be switched on: {}", words_, said));
    }
    // The controller itself takes the force off when no command comes: nothing of ours is needed for that.
    watchdog_ = dhd_.enableExpertMode != nullptr && dhd_.setWatchdog != nullptr && dhd_.enableExpertMode() >= 0 &&
                dhd_.setWatchdog(static_cast<unsigned char>(PolledDevice::kStaleNs / dhd::kWatchdogUnitNs), id_) >= 0;
    describe();
    errors_ = 0;
  }

  // Its forces were switched off beside a call that hung, or by its own watchdog when no command came.
  bool mustEnable(std::int64_t now) noexcept {
    const bool silent = watchdog_ && toldNs_ != 0 && now - toldNs_ > PolledDevice::kStaleNs;
    toldNs_ = now;
    return cut_.exchange(false, std::memory_order_acq_rel) || silent;
  }

  void shut() noexcept {
    if (!isOpen_) return;
    isOpen_ = false;
    dhd_.setForce(0, 0, 0, id_);
    if (dhd_.stop != nullptr) dhd_.stop(id_);
    dhd_.close(id_);
  }

  void describe() {
    const char* name = dhd_.getSystemName != nullptr ? dhd_.getSystemName(id_) : nullptr;
    std::uint16_t serial = 0;
    const bool hasSerial = dhd_.getSerialNumber != nullptr && dhd_.getSerialNumber(&serial, id_) >= 0;
    info_.name = fmt::format("{}{}", name != nullptr && *name != 0 ? name : "Force Dimension", hasSerial ? fmt::format(" {}", serial) : "");
    info_.version = "DHD, " + dhd_.library.name();
    const int type = dhd_.getSystemType != nullptr ? dhd_.getSystemType(id_) : -1;
    const auto model = std::find_if(std::begin(kKnownModels), std::end(kKnownModels), [&](const Model& m) { return m.type == type; });
    info_.maxForce = model != std::end(kKnownModels) ? model->maxForce : kUnknownForce;
    info_.workspaceRadius = model != std::end(kKnownModels) ? model->radius : kUnknownRadius;
    if (const double told = dhd_.getMaxForce != nullptr ? dhd_.getMaxForce(id_) : 0; std::isfinite(told) && told > 0) info_.maxForce = told;
    info_.rendersForce = true;
    info_.rate = 1e9 / kPeriodNs;
    info_.secondPath = PolledDevice::describeStale() + ", and another thread switches its forces off when a call hangs for as long" +
                       (watchdog_ ? "; its own watchdog does so too" : "; its library offers no watchdog");
    deviceVelocity_ = deviceVelocity_ && dhd_.getLinearVelocity != nullptr;
  }

  Exchange fault() {
    const int code = dhd_.errorGetLast != nullptr ? dhd_.errorGetLast() : dhd::kComm;
    if (code == dhd::kNoDevice || code == dhd::kNotAvailable || ++errors_ >= kMostErrors) return Exchange::Lost;
    return Exchange::Nothing;
  }

  const dhd::Api& dhd_;
  char id_;
  std::string words_;
  haptics::DeviceInfo info_;
  bool deviceVelocity_, isOpen_ = false, watchdog_ = false;
  std::atomic<bool> cut_{false};
  std::int64_t toldNs_ = 0;  // when an exchange began last
  int errors_ = 0;           // in a row
};

}  // namespace

std::shared_ptr<Transport> openForceDimension(int index, const std::string& words, bool deviceVelocity) {
  return std::make_shared<ForceDimension>(index, words, deviceVelocity);
}

namespace {

std::unique_ptr<haptics::HapticDevice> makeForceDimension(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  int index = 0;
  const std::string& plain = options.plain();
  if (!plain.empty()) {
    if (plain.size() > 2 || plain.find_first_not_of("0123456789") != std::string::npos)
      throw FaultError(Fault{"device", "is " + request.words(), "forcedimension:N with N = 0, 1, …"});
    index = std::stoi(plain);
  }
  const bool deviceVelocity = options.word("velocity", {"estimated", "device"}) == "device";
  options.done();
  return std::make_unique<PolledDevice>(openForceDimension(index, request.words(), deviceVelocity));
}

std::vector<FoundDevice> findForceDimension(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  try {
    const int count = dhd::api().getDeviceCount();
    if (count <= 0) {
      const bool silent = dhd::api().errorGetLast == nullptr || dhd::api().errorGetLast() == dhd::kNone;
      return {absentDevice(self, fmt::format("{}: no device is connected{}", dhd::api().library.name(),
                                             silent ? std::string() : ": " + dhd::api().lastError()))};
    }
    for (int i = 0; i < count; ++i) {
      const std::string key = std::to_string(i);
      try {
        found.push_back(presentDevice(self, key, ForceDimension(i, fmt::format("device {}:{}", self.name, i), false).info()));
      } catch (const ResourceError& error) {
        found.push_back(absentDevice(self, error.what(), key));
      }
    }
  } catch (const ResourceError& error) {
    return {absentDevice(self, error.what())};
  }
  return found;
}

}  // namespace

DeviceDriver forceDimensionDriver() {
  return {"forcedimension", "forcedimension[:N]",
          "omega, delta, sigma, lambda and Falcon by Force Dimension's library (libdrd.so or libdhd.so)", findForceDimension,
          makeForceDimension};
}

}  // namespace reachlab::devices
