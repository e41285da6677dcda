#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "base/math/vec3.h"

namespace reachlab::dynamics {

/// The end of a step. Every status except Ok leads to zero force. Statuses are counted per kind and never thrown.
enum class StepStatus : std::uint8_t { Ok, HandLost, NotFinite, Capped, AtEnd, NoContinuation, PeerLost };
inline constexpr int kStepStatusCount = 7;
std::string_view describe(StepStatus status);

/// One mass in world coordinates, with its constraint parameters. Unused parameters are 0. A free object has no parameters.
struct MassState {
  Vec3 r, v, a;                        // [m], [m/s], [m/s^2]
  std::array<double, 2> q{}, qRate{};  // phi or u, v (no unit), and their rates [1/s]
};

/// Orientation of a body: unit quaternion (w, x, y, z) and angular velocity [rad/s], world frame.
struct BodyState {
  std::array<double, 4> orientation{1, 0, 0, 0};
  Vec3 angularVelocity;
};

}  // namespace reachlab::dynamics
