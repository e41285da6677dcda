#include "devices/virtual/device_model.h"

#include <algorithm>

namespace reachlab::devices {
namespace {

constexpr DeviceModel kModels[] = {
    {"omni", "PHANToM Omni", 0.045, 0.26, 0, 0.055e-3, 3.3, 0.88, 0.10, "SensAble, PHANTOM Omni data sheet"},
    {"premium15", "PHANToM Premium 1.5", 0.075, 0.04, 0, 0.03e-3, 8.5, 1.4, 0.12, "SensAble, PHANTOM Premium 1.5 data sheet"},
    {"premium60", "PHANToM Premium 1.5/6DOF", 0.136, 0.04, 0, 0.03e-3, 8.5, 1.4, 0.12, "SensAble, PHANTOM Premium 1.5/6DOF data sheet"},
    {"highforce", "PHANToM Premium 1.5 High Force", 0.150, 0.20, 0, 0.007e-3, 37.5, 6.2, 0.12,
     "SensAble, PHANTOM Premium 1.5 High Force data sheet"},
    {"omega3", "Force Dimension omega.3", 0.22, 0.10, 0, 0.01e-3, 12, 12, 0.08,
     "Force Dimension, omega.3 specification (force, resolution, workspace); mass and friction assumed"},
    {"inverse3", "Haply Inverse3", 0.20, 0.10, 0, 0.01e-3, 10, 2.5, 0.17,
     "Haply, Inverse3 specification (force, resolution, workspace); mass and friction assumed"},
};

}  // namespace

std::span<const DeviceModel> deviceModels() { return kModels; }

const DeviceModel* findDeviceModel(std::string_view name) {
  const auto at = std::find_if(std::begin(kModels), std::end(kModels), [&](const DeviceModel& m) { return m.name == name; });
  return at == std::end(kModels) ? nullptr : at;
}

}  // namespace reachlab::devices
