#include "devices/virtual/device_model.h"

#include <algorithm>

namespace reachlab::devices {
namespace {

// Peak force and workspace of the PHANToMs and of the omega.3 are those that CHAI3D drives them with (chai3d/chai3d:src/devices/
// CPhantomDevices.cpp and CDeltaDevices.cpp, read); all else is assumed: docs/devices.md marks each number.
constexpr DeviceModel kModels[] = {
    {"omni", "PHANToM Omni", 0.045, 0.26, 0, 0.055e-3, 3.3, 0.88, 0.10},
    {"premium15", "PHANToM Premium 1.5", 0.075, 0.04, 0, 0.03e-3, 8.5, 1.4, 0.12},
    {"premium60", "PHANToM Premium 1.5/6DOF", 0.136, 0.04, 0, 0.03e-3, 8.5, 1.4, 0.12},
    {"highforce", "PHANToM Premium 1.5 High Force", 0.150, 0.20, 0, 0.007e-3, 37.5, 6.2, 0.12},  // assumed; the paper says 37 N
    {"omega3", "Force Dimension omega.3", 0.22, 0.10, 0, 0.01e-3, kOmegaForce, kOmegaForce, kOmegaRadius},
    {"inverse3", "Haply Inverse3", 0.20, 0.10, 0, 0.01e-3, 10, 2.5, 0.17},  // assumed
};

}  // namespace

std::span<const DeviceModel> deviceModels() { return kModels; }

const DeviceModel* findDeviceModel(std::string_view name) {
  const auto at = std::find_if(std::begin(kModels), std::end(kModels), [&](const DeviceModel& m) { return m.name == name; });
  return at == std::end(kModels) ? nullptr : at;
}

}  // namespace reachlab::devices
