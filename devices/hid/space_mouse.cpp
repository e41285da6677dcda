#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/device_options.h"
#include "base/error.h"
#include "base/system/os.h"
#include "devices/driver/drivers.h"
#include "devices/hid/hid_port.h"
#include "devices/hid/space_mouse_report.h"
#include "devices/io/rate_hand.h"
#include "sim/trial/protocol.h"
#include "sim/trial/task_places.h"

/// 3Dconnexion SpaceMouse: six axes of push without force, every 8 ms (wired). Verified against published reports, not on a device.
namespace reachlab::devices {
namespace {

constexpr std::uint16_t kLogitech = 0x046D, k3Dconnexion = 0x256F;

bool isSpaceMouse(const HidInterface& at) {
  constexpr std::uint16_t older[] = {0xC603, 0xC605, 0xC606, 0xC621, 0xC623, 0xC625, 0xC626, 0xC627, 0xC628, 0xC629, 0xC62B};
  return at.vendor == k3Dconnexion ||
         (at.vendor == kLogitech && std::find(std::begin(older), std::end(older), at.product) != std::end(older));
}

std::vector<HidInterface> findSpaceMice() {
  std::vector<HidInterface> found = findHid();
  std::erase_if(found, [](const HidInterface& at) { return !isSpaceMouse(at); });
  return found;
}

HidInterface chooseSpaceMouse(const std::string& key, const std::string& words) {
  const std::vector<HidInterface> mice = findSpaceMice();
  if (const HidInterface* mouse = chooseHid(mice, key)) return *mouse;
  throw ResourceError(fmt::format("{}: no such 3Dconnexion SpaceMouse is connected", words));
}

class SpaceMouseSource final : public DeflectionSource {
 public:
  SpaceMouseSource(std::string key, std::string words)
      : key_(std::move(key)), words_(std::move(words)), port_(std::make_unique<HidPort>(chooseSpaceMouse(key_, words_))) {}

  // Everything that waits is taken, so that the newest is never seconds old.
  bool wait(Deflection& newest, bool& lost) override {
    if (!port_ && !reopen()) {
      lost = true;
      return false;
    }
    std::array<std::uint8_t, 32> report{};
    bool came = false;
    constexpr int kMost = 256, kWaitMs = 50;
    for (int i = 0; i < kMost; ++i) {
      const int got = port_->read(report, came ? 0 : kWaitMs);
      if (got < 0) {
        port_.reset();
        lost = true;
        return false;
      }
      if (got == 0) break;
      came = takeSpaceMouseReport({report.data(), static_cast<std::size_t>(got)}, state_) || came;
    }
    newest = {state_.push, state_.buttons};
    return came;
  }

 private:
  bool reopen() {
    constexpr std::int64_t kPauseNs = 200'000'000;
    os::sleepUntil(os::now() + kPauseNs);
    try {
      port_ = std::make_unique<HidPort>(chooseSpaceMouse(key_, words_));
      state_ = {};
      return true;
    } catch (const ResourceError&) {
      return false;
    }
  }
  std::string key_, words_;
  std::unique_ptr<HidPort> port_;
  SpaceMouseState state_;
};

std::unique_ptr<haptics::HapticDevice> makeSpaceMouse(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  RateHand::Options chosen;
  chosen.gain = options.number("gain", chosen.gain, 0.01, 5);
  chosen.deadZone = options.number("dead-zone", chosen.deadZone, 0, 0.5);
  options.done();
  const HidInterface mouse = chooseSpaceMouse(options.plain(), request.words());
  const Vec3 start = trial::startOf(request.experiment);
  const haptics::DeviceInfo info{
      .name = mouse.title.empty() ? "SpaceMouse" : mouse.title, .version = "HID", .rate = 125, .workspaceCentre = start, .steered = true};
  return std::make_unique<RateHand>(info, chosen, start, std::make_shared<SpaceMouseSource>(mouse.key(), request.words()));
}

std::vector<FoundDevice> findSpaceMouseDevices(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  for (const HidInterface& mouse : findSpaceMice())
    found.push_back(presentDevice(self, mouse.key(), {.name = mouse.title, .degreesOfFreedom = 6, .rate = 125}, whyNotOpen(mouse)));
  return rowsOr(std::move(found), self, "no 3Dconnexion SpaceMouse (USB 256f, 046d:c6xx) is connected");
}

}  // namespace

DeviceDriver spaceMouseDriver() {
  return {"spacemouse", "spacemouse[:SERIAL][,gain=M_PER_S,dead-zone=SHARE]", "3Dconnexion SpaceMouse: the push steers the hand's speed",
          findSpaceMouseDevices, makeSpaceMouse};
}

}  // namespace reachlab::devices
