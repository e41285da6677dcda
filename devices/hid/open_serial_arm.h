#pragma once
#include <array>
#include <span>
#include <string_view>

#include "base/math/vec3.h"

/// The open WoodenHaptics and Polhem arms. They have three motors, capstan drives and a serial linkage. The second and the third joint are
/// both measured against the base. Frame of the arm: x towards the user, y right, z up [m].
///
///   theta_i = s_i 2 pi enc_i / cpr_i / r_i      r_i = D_body,i / D_capstan,i;  s_i = -1 where motor and body turn alike, else +1
///   R = Lb sin thB + Lc sin thC
///   x = cos thA R - x0,  y = sin thA R - y0,  z = Ln + Lb cos thB - Lc cos thC - z0
///   tau = J^T F,  I_i = s_i tau_i / r_i / kt_i
namespace reachlab::devices {

/// The defaults are the values of most models.
struct ArmModel {
  std::string_view name;
  std::array<double, 3> length;                               // [m] L_a (Ln), L_b, L_c
  std::array<double, 3> body;                                 // [m] diameter
  std::array<double, 3> capstan{.010, .010, .010};            // [m] diameter
  Vec3 origin;                                                // [m] of the workspace
  std::array<double, 3> torqueConstant{.0259, .0259, .0259};  // [Nm/A]
  double countsPerTurn = 2000;
  double maxForce = 5;                     // [N] data sheet
  std::array<int, 3> calibrationCounts{};  // encoders in the calibration pose
  std::array<bool, 3> aligned{};           // motor and body turn alike
};

/// Every model with public kinematics (variants 0 to 2).
std::span<const ArmModel> armModels();
/// Null when no model has that name.
const ArmModel* findArmModel(std::string_view name);

/// Joint angles [rad] of encoder counts.
std::array<double, 3> jointAngles(const ArmModel& model, const std::array<double, 3>& counts) noexcept;
/// The position of the handle [m] in the frame of the arm.
Vec3 handlePlace(const ArmModel& model, const std::array<double, 3>& angles) noexcept;
/// d(x, y, z)/d(angles), rows x, y, z.
std::array<Vec3, 3> jacobianRows(const ArmModel& model, const std::array<double, 3>& angles) noexcept;
/// Torques of the joints [N m] for a force at the handle.
std::array<double, 3> jointTorques(const ArmModel& model, const std::array<double, 3>& angles, const Vec3& force) noexcept;
/// Currents of the motors [A] for a force [N]. All three are scaled by one factor where any of them would exceed `maxCurrent`, so that the
/// force keeps its direction. A force or an angle that is not finite gives zero.
std::array<double, 3> motorCurrents(const ArmModel& model, const std::array<double, 3>& angles, const Vec3& force,
                                    double maxCurrent) noexcept;

}  // namespace reachlab::devices
