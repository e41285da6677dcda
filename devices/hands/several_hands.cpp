#include "devices/hands/several_hands.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/fault.h"

namespace reachlab::devices {
namespace {

constexpr std::string_view kBetween = " + ";

class SeveralHands final : public haptics::HapticDevice {
 public:
  explicit SeveralHands(std::vector<std::unique_ptr<haptics::HapticDevice>> devices) : devices_(std::move(devices)) {}

  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info = first().info();
    for (const auto& device : devices_) info.virtualHand = info.virtualHand && device->info().virtualHand;
    return info;
  }
  void prepareTrial(int index, int scene = 0) override {
    for (const auto& device : devices_) device->prepareTrial(index, scene);
  }
  void cue(haptics::Cue cue) noexcept override {
    for (const auto& device : devices_) device->cue(cue);
  }
  haptics::DeviceSample read() noexcept override { return first().read(); }
  void write(const Vec3& force) noexcept override { first().write(force); }
  void see(std::span<const dynamics::MassState> masses) noexcept override {
    for (const auto& device : devices_) device->see(masses);
  }
  std::vector<haptics::HapticDevice*> hands() override {
    std::vector<haptics::HapticDevice*> all;
    for (const auto& device : devices_) all.push_back(device.get());
    return all;
  }

  // The worst of them: the states are in the order of how bad they are, but that one to calibrate can still be used.
  haptics::DeviceHealth health() const noexcept override {
    haptics::DeviceHealth worst = haptics::DeviceHealth::Ready;
    for (const auto& device : devices_) worst = std::max(worst, device->health());
    return worst;
  }
  std::string healthText() const override {
    return collect([](const haptics::HapticDevice& device) { return device.healthText(); });
  }
  std::string calibrationHint() const override {
    return collect([](const haptics::HapticDevice& device) { return device.calibrationHint(); });
  }
  void calibrate() override {
    for (const auto& device : devices_) device->calibrate();
  }
  bool stopForce() noexcept override {
    bool stopped = true;
    for (const auto& device : devices_) stopped = device->stopForce() && stopped;
    return stopped;
  }
  void startClock(ClockTick tick, void* context) override { first().startClock(tick, context); }
  void stopClock() noexcept override { first().stopClock(); }

 private:
  haptics::HapticDevice& first() const { return *devices_.front(); }
  template <class Ask>
  std::string collect(Ask&& ask) const {
    std::string all;
    for (const auto& device : devices_)
      if (const std::string said = ask(*device); !said.empty())
        all += fmt::format("{}{}: {}", all.empty() ? "" : "; ", device->info().name, said);
    return all;
  }

  std::vector<std::unique_ptr<haptics::HapticDevice>> devices_;
};

}  // namespace

std::vector<std::string> splitHands(const std::string& spec) {
  std::vector<std::string> hands;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = spec.find(kBetween, at);
    hands.push_back(spec.substr(at, end == std::string::npos ? end : end - at));
    if (end == std::string::npos) return hands;
    at = end + kBetween.size();
  }
}

std::string joinHands(const std::vector<std::string>& specs) { return fmt::format("{}", fmt::join(specs, kBetween)); }

std::unique_ptr<haptics::HapticDevice> joinDevices(std::vector<std::unique_ptr<haptics::HapticDevice>> devices) {
  for (std::size_t i = 1; i < devices.size(); ++i)
    if (const haptics::DeviceInfo info = devices[i]->info(); info.drivesClock)
      throw FaultError(Fault{"device", fmt::format("{} drives the clock, and is not the first", info.name),
                             "one device that drives the clock, named first"});
  if (devices.size() == 1) return std::move(devices.front());
  return std::make_unique<SeveralHands>(std::move(devices));
}

}  // namespace reachlab::devices
