#pragma once
#include <cstdint>
#include <vector>

#include "devices/registry.h"

/// What is plugged in and out while the program runs, as far as it shows as a node of the system: HID, serial lines, keyboards, gamepads,
/// tablets. Vendors' libraries are not asked: they would open devices.
namespace reachlab::devices {

/// Another number when a node has come, gone, or changed its rights. Some microseconds; any thread.
std::uint64_t pluggedFingerprint();
/// The devices behind those nodes that are there now.
std::vector<FoundDevice> findPlugged();

}  // namespace reachlab::devices
