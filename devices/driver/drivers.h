#pragma once
#include "devices/driver/registry.h"

/// The entry of every driver. Each entry is defined beside its driver.
namespace reachlab::devices {

DeviceDriver simulatedDriver();
DeviceDriver partnerDriver();
DeviceDriver replayDriver();
DeviceDriver mouseDriver();
DeviceDriver virtualDriver();
DeviceDriver phantomDriver();
DeviceDriver forceDimensionDriver();
DeviceDriver hidDriver();
DeviceDriver spaceMouseDriver();
DeviceDriver haplyDriver();
DeviceDriver polhemDriver();
DeviceDriver tabletDriver();

}  // namespace reachlab::devices
