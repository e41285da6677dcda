#pragma once
#include <span>
#include <string_view>

namespace reachlab::devices {

/// A force device as a body, in published numbers. We measured no device.
struct DeviceModel {
  std::string_view name, title;
  double mass;             // [kg] apparent, at the handle
  double friction;         // [N] Coulomb, to move it backwards
  double viscosity;        // [N s/m] not published by makers: 0
  double resolution;       // [m]
  double maxForce;         // [N] nominal peak
  double continuousForce;  // [N]
  double workspaceRadius;  // [m]
};

/// Peak force [N] and radius of the workspace [m] of every omega, as CHAI3D drives it (chai3d/chai3d:src/devices/CDeltaDevices.cpp).
inline constexpr double kOmegaForce = 12, kOmegaRadius = 0.075;

std::span<const DeviceModel> deviceModels();
/// Null when no model has that name.
const DeviceModel* findDeviceModel(std::string_view name);

}  // namespace reachlab::devices
