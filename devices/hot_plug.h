#pragma once
#include <cstdint>
#include <vector>

#include "devices/driver/registry.h"

/// Detects devices that are plugged in or out while the program runs, if they show as a node of the system.
namespace reachlab::devices {

/// Returns another number when a node has come, has gone, or has changed its rights. Takes some microseconds. Any thread.
std::uint64_t pluggedFingerprint();
/// The devices that are present now and need no vendor's library: HID devices, serial lines and tablets. A vendor's library would open its
/// devices.
std::vector<FoundDevice> findPlugged();

}  // namespace reachlab::devices
