#pragma once
#include <cstdint>
#include <vector>

#include "devices/driver/registry.h"

/// What is plugged in and out while the program runs, as far as it shows as a node of the system.
namespace reachlab::devices {

/// Another number when a node has come, gone, or changed its rights. Some microseconds; any thread.
std::uint64_t pluggedFingerprint();
/// The devices that are there now and need no vendor's library, which would open them: HID, serial lines, tablets.
std::vector<FoundDevice> findPlugged();

}  // namespace reachlab::devices
