#include "devices/hid/open_serial_arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reachlab::devices {
namespace {

constexpr ArmModel kWooden{.name = "woodenhaptics_v2015",
                           .length = {.080, .205, .245},
                           .body = {.160, .120, .120},
                           .origin = {.220, 0, .080},
                           .calibrationCounts = {0, 0, 6000}};

constexpr ArmModel later(ArmModel model) {
  model.name = "woodenhaptics_v2019";
  model.torqueConstant = {.321, .0603, .0603};
  return model;
}
constexpr ArmModel woody(ArmModel model) {
  model.name = "default_woody";
  model.calibrationCounts = {};
  model.aligned = {false, true, false};
  return model;
}

constexpr ArmModel kModels[] = {
    kWooden,
    later(kWooden),
    woody(kWooden),
    {.name = "polhem_v1",
     .length = {.058, .174, .133},
     .body = {.180, .100, .100},
     .origin = {.140, 0, .100},
     .torqueConstant = {.0538, .0538, .0538},
     .calibrationCounts = {0, 0, -5000},
     .aligned = {true, true, true}},
    {.name = "aluhaptics_v2",
     .length = {.111, .140, .111},
     .body = {.116, .076, .076},
     .capstan = {.0138, .0098, .0098},
     .origin = {.140, 0, 0}},
    {.name = "vintage",
     .length = {.056, .138, .112},
     .body = {.117, .077, .077},
     .capstan = {.013, .010, .010},
     .origin = {.140, 0, 0},
     .torqueConstant = {.0163, .0163, .0163},
     .countsPerTurn = 4000},
};

double reduction(const ArmModel& m, int i) noexcept { return m.body[i] / m.capstan[i]; }
double sign(const ArmModel& m, int i) noexcept { return m.aligned[i] ? -1 : 1; }

}  // namespace

std::span<const ArmModel> armModels() { return kModels; }

const ArmModel* findArmModel(std::string_view name) {
  const auto at = std::find_if(std::begin(kModels), std::end(kModels), [&](const ArmModel& m) { return m.name == name; });
  return at == std::end(kModels) ? nullptr : at;
}

std::array<double, 3> jointAngles(const ArmModel& m, const std::array<double, 3>& counts) noexcept {
  std::array<double, 3> angles{};
  for (int i = 0; i < 3; ++i) angles[i] = sign(m, i) * 2 * std::numbers::pi * counts[i] / m.countsPerTurn / reduction(m, i);
  return angles;
}

Vec3 handlePlace(const ArmModel& m, const std::array<double, 3>& th) noexcept {
  const double out = m.length[1] * std::sin(th[1]) + m.length[2] * std::sin(th[2]);
  return Vec3{std::cos(th[0]) * out, std::sin(th[0]) * out, m.length[0] + m.length[1] * std::cos(th[1]) - m.length[2] * std::cos(th[2])} -
         m.origin;
}

std::array<Vec3, 3> jacobianRows(const ArmModel& m, const std::array<double, 3>& th) noexcept {
  const double ca = std::cos(th[0]), sa = std::sin(th[0]), lb = m.length[1], lc = m.length[2];
  const double out = lb * std::sin(th[1]) + lc * std::sin(th[2]);
  return {Vec3{-sa * out, lb * ca * std::cos(th[1]), lc * ca * std::cos(th[2])},
          Vec3{ca * out, lb * sa * std::cos(th[1]), lc * sa * std::cos(th[2])}, Vec3{0, -lb * std::sin(th[1]), lc * std::sin(th[2])}};
}

std::array<double, 3> jointTorques(const ArmModel& m, const std::array<double, 3>& th, const Vec3& f) noexcept {
  const auto j = jacobianRows(m, th);
  return {j[0].x * f.x + j[1].x * f.y + j[2].x * f.z, j[0].y * f.x + j[1].y * f.y + j[2].y * f.z,
          j[0].z * f.x + j[1].z * f.y + j[2].z * f.z};
}

std::array<double, 3> motorCurrents(const ArmModel& m, const std::array<double, 3>& th, const Vec3& force, double maxCurrent) noexcept {
  const std::array<double, 3> torque = jointTorques(m, th, force);
  std::array<double, 3> current{};
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    current[i] = sign(m, i) * torque[i] / reduction(m, i) / m.torqueConstant[i];
    most = std::max(most, std::abs(current[i]));
    if (!std::isfinite(current[i])) return {};
  }
  if (most > maxCurrent)
    for (double& i : current) i *= maxCurrent / most;
  return current;
}

}  // namespace reachlab::devices
