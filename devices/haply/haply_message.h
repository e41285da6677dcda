#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec3.h"

/// Messages of Haply's Inverse service (docs.haply.co, websocket protocol of the services 3.1 to 3.5). Pure functions that any thread may
/// call.
namespace reachlab::devices {

/// One message of the service, as far as this program needs it. Axes of the device: x right, y away from the user, z up. Units: m, m/s.
struct HaplyState {
  std::string id;
  Vec3 position;
  std::optional<Vec3> velocity;
  std::uint32_t buttons = 0;  // of the grip: a, b, c from bit 0
};

enum class HaplyAnswer : std::uint8_t {
  State,
  NotJson,       // no message of any version of the service
  OtherVersion,  // a message of the service, in an unknown version of the protocol
  NoDevice,      // no Inverse3 (of this name) is connected to the service
};

/// Reads one message. `id` names the device, and an empty `id` means the first device. A missing coordinate is zero, because the service
/// leaves out values that equal its identity. `grip` names the VerseGrip that is held with the device. An empty `grip` means the only grip.
/// With several grips no grip is used, because the service does not tell which grip belongs to which device.
HaplyAnswer readHaplyMessage(std::string_view message, const std::string& id, HaplyState& state, const std::string& grip = {});

/// The part of a message that describes the service.
struct HaplyService {
  std::vector<std::string> devices, grips;  // names of all of them
  std::string
      settings;  // of the device that change the felt force (gravity compensation, filters), as the service names them; may be empty
};
HaplyService readHaplyService(std::string_view message, const std::string& id = {});

/// The command that tells the device this force [N] in the device's axes. A force that is not finite becomes zero force.
std::string haplyForceCommand(const std::string& id, const Vec3& force);
/// The first message of a client, for which the service waits.
std::string haplyGreeting();

/// From the device's axes to the world's (x to the right, y up, z towards the user), and back.
constexpr Vec3 haplyToWorld(const Vec3& v) noexcept { return {v.x, v.z, -v.y}; }
constexpr Vec3 worldToHaply(const Vec3& v) noexcept { return {v.x, -v.z, v.y}; }

}  // namespace reachlab::devices
