#pragma once
#include <cstdint>
#include <string_view>

#include "base/math/vec3.h"

namespace reachlab::haptics {

/// Forces on the hand beside the object, and the control of energy. Recorded with a run.
struct GuardSettings {
  Vec3 wallCentre;             // [m]
  double wallRadius = 0;       // [m] 0: no wall
  double wallStiffness = 500;  // [N/m]
  double wallDamping = 2;      // [N s/m]; K T/2 + B = 2.25 N s/m at 1 kHz, less than a hand brings that holds the device
  Vec3 compensation;           // [N] held against the weight of what hangs on the device, also between trials
  bool passivityControl = false;

  bool operator==(const GuardSettings&) const = default;
};

/// The state of a device that renders force. Each change is an event of the recording.
enum class DeviceState : std::uint8_t {
  Off,      // not seen, or lost
  Homed,    // its place is known; no object
  Armed,    // a trial is queued. No force yet, the hand is to come to the start
  Engaged,  // the object is felt
  Fault,    // latched: zero until the experimenter resets it
};
std::string_view nameOf(DeviceState state);  // "off", "homed", …

/// Reasons why the device got another force than the object gave, as bits. Beginning and end of each are events.
namespace intervention {
inline constexpr std::uint8_t kLimit = 1;       // the instantaneous limit
inline constexpr std::uint8_t kHeat = 2;        // the budget of the continuous force
inline constexpr std::uint8_t kRamp = 4;        // force that returns grows slowly
inline constexpr std::uint8_t kSlew = 8;        // the change in one tick
inline constexpr std::uint8_t kWall = 16;       // the hand is beyond the workspace
inline constexpr std::uint8_t kPassivity = 32;  // the passivity controller dissipates
inline constexpr std::uint8_t kNotFinite = 64;  // the force was no number: latched
inline constexpr std::uint8_t kHeldBack = 128;  // no force: the hand is lost or released, or a gap precedes the tick
inline constexpr int kCount = 8;
std::string_view nameOf(int bit);  // of 1 << bit: "limit", "heat", …
}  // namespace intervention

/// Force that keeps the hand within the wall's sphere: F = -(K (|d| - R) + B max(v . n, 0)) n. d points from the centre, n = d/|d|. Zero
/// inside. It pushes inwards only.
Vec3 wallForce(const GuardSettings& settings, const Vec3& place, const Vec3& velocity) noexcept;

/// Time-domain passivity observer and controller (Hannaford and Ryu 2002) at the port between hand and device. Between two ticks the force
/// F on the hand is held. The work of the hand on the program is therefore exactly E(n) = E(n-1) - F(n-1) . (x(n) - x(n-1)). Below
/// zero, the program has given more than it was given. The controller then takes it back by F_pc = -alpha v, alpha = -E/(T v^2), at most
/// kMaxDissipation. Haptic thread. Neither allocates nor throws.
class PassivityObserver {
 public:
  static constexpr double kMaxDissipation = 5;  // [N s/m]; more would make the loop itself unstable (Colgate)

  void reset() noexcept { *this = {}; }
  /// The hand's place at this tick [m].
  void observe(const Vec3& place) noexcept;
  /// [J] given by the hand so far.
  double energy() const noexcept { return energy_; }
  /// [N] to be added so that the energy returns to zero. Zero unless the energy is negative.
  Vec3 control(const Vec3& velocity) const noexcept;
  /// The force [N] that the hand feels from this tick to the next.
  void render(const Vec3& force) noexcept { force_ = force; }

 private:
  Vec3 place_, force_;
  double energy_ = 0;
  bool seen_ = false;
};

}  // namespace reachlab::haptics
