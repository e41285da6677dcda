#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec3.h"

/// Messages of Haply's Inverse service (docs.haply.co, websocket protocol of the services 3.1 to 3.5). Pure functions; any thread.
namespace reachlab::devices {

/// One message of the service, as far as we need it. Its own axes: x right, y away from the user, z up; m, m/s.
struct HaplyState {
  std::string id;
  Vec3 position;
  std::optional<Vec3> velocity;
  std::optional<std::array<double, 4>> orientation;  // of the grip; w, x, y, z
  std::uint32_t buttons = 0;                         // a, b, c from bit 0
};

enum class HaplyAnswer : std::uint8_t {
  State,
  NotJson,       // or not as a service of any version speaks
  OtherVersion,  // a service, but not of a protocol that we know
  NoDevice,      // no Inverse3 (of this name) is connected to the service
};

/// Reads one message; `id`: of the device that is asked for, empty: the first. A coordinate that is not there is zero, as the service leaves
/// out what equals its identity. `grip`: of the VerseGrip that is held with it; empty: the only one, and none where there are several, as
/// the service does not tell which is at which device.
HaplyAnswer readHaplyMessage(std::string_view message, const std::string& id, HaplyState& state, const std::string& grip = {});
/// Names of all Inverse3, and of all grips, in a message.
std::vector<std::string> haplyDevices(std::string_view message);
std::vector<std::string> haplyGrips(std::string_view message);
/// What of the device's configuration changes what is felt (gravity compensation, filters), in the service's own words; empty: not told.
std::string haplySettings(std::string_view message, const std::string& id);

/// The command that tells the device this force [N], its own axes; not finite: none.
std::string haplyForceCommand(const std::string& id, const Vec3& force);
/// What a client says first, when the service waits for it.
std::string haplyGreeting();

/// Its axes to the world's (x to the right, y up, z towards the user), and back.
constexpr Vec3 haplyToWorld(const Vec3& v) noexcept { return {v.x, v.z, -v.y}; }
constexpr Vec3 worldToHaply(const Vec3& v) noexcept { return {v.x, -v.z, v.y}; }

}  // namespace reachlab::devices
