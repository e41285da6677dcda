#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "base/math/vec3.h"

namespace reachlab::experiment {

template <std::size_t N>
using SquareMatrix = std::array<std::array<double, N>, N>;

inline Vec3 times(const SquareMatrix<3>& m, const Vec3& v) noexcept {
  return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
          m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
}

/// F = B v.
struct ViscousForce {
  SquareMatrix<3> matrix{};  // [N s/m] B
  bool operator==(const ViscousForce&) const = default;
};

/// F = -K (x - c).
struct ElasticForce {
  SquareMatrix<3> matrix{};    // [N/m] K
  std::optional<Vec3> centre;  // [m] c; the task's start where it is not given
  bool operator==(const ElasticForce&) const = default;
};

/// A torque W times the rate of the joint angles, as the hand feels it: F = J^-T W J^-1 v. Both angles are absolute. The plane is that of
/// the arm.
struct JointViscousForce {
  SquareMatrix<2> matrix{};  // [N m s/rad] W
  bool operator==(const JointViscousForce&) const = default;
};

/// Walls beside the line from start to target. Where the distance d from the line is more than w, F = -K (d - w) n - D d' n.
struct ChannelForce {
  double stiffness = 1000;      // [N/m] K
  double damping = 15;          // [N s/m] D
  double halfWidth = 0;         // [m] w
  double ramp = 0.5;            // [s] in which the walls grow
  double breakDistance = 0.03;  // [m] beyond it the channel lets go for the rest of the trial
  bool operator==(const ChannelForce&) const = default;
};

/// The beginning of a pulse. Exactly one of the two members has a value.
struct PulseInstant {
  std::optional<double> onset;     // [s] after movement onset
  std::optional<double> distance;  // [m] of the hand from the start
  bool operator==(const PulseInstant&) const = default;
};

/// A trapezoid in time.
struct PulseForce {
  Vec3 force;  // [N]
  PulseInstant at;
  double duration = 0.1;  // [s] with rise and fall
  double rise = 0.01;     // [s] also of the fall
  bool operator==(const PulseForce&) const = default;
};

/// Movement: from movement onset to the end of the trial. Trial: from arming. A pulse has its own instant.
enum class ForceWhen : std::uint8_t { Movement, Trial };

using ForceLaw = std::variant<ViscousForce, ElasticForce, JointViscousForce, ChannelForce, PulseForce>;

/// A force on the hand itself, beside that of the object.
struct HandForce {
  ForceLaw law;
  ForceWhen when = ForceWhen::Movement;
  bool operator==(const HandForce&) const = default;
};
/// The forces add up.
using Environment = std::vector<HandForce>;

}  // namespace reachlab::experiment
