#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/device_options.h"
#include "devices/mapping/mapping.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// The options of every device besides its driver's options.
struct HandSettings {
  Mapping mapping = {};
  bool mapped = false;
  std::optional<double> wall = {};        // [m] radius in the world; 0: the device's own workspace
  std::optional<double> speedLimit = {};  // [m/s] of the hand in the world
  std::optional<double> stylusMass = {};  // [kg] held against its weight
  bool passivityControl = false;
  int deadManButton = 0;  // counted from 1: force only while this button is held; 0: no such button
  bool any() const { return mapped || wall || speedLimit || stylusMass || passivityControl || deadManButton > 0; }
};

/// Takes `mapping=FILE`, `scale=`, `offset=X/Y/Z` [m], `rotation=X/Y/Z` [deg], `mirror=x`, `wall=yes|RADIUS_M`, `speed-limit=M_PER_S`,
/// `stylus-mass=KG`, `passivity=control`, `dead-man-button=N`. Throws FaultError.
HandSettings takeHandSettings(DeviceOptions& options);

/// The device as the world sees it, with its mapping and its guards. Without any option it is the device itself.
std::unique_ptr<haptics::HapticDevice> guardDevice(std::unique_ptr<haptics::HapticDevice> device, const HandSettings& options);

}  // namespace reachlab::devices
