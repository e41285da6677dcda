#pragma once
#include <functional>
#include <memory>

#include "devices/input/event_node.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

using OpenInput = std::function<std::unique_ptr<InputPort>()>;  // throws ResourceError while it is not there

/// A pen on a tablet: its place on the tablet is the hand's place in the plane of x and y, `halfWidth` [m] from the middle to the right edge,
/// played back by the events' own times as the mouse's are (mouse_device.h).
std::unique_ptr<haptics::HapticDevice> makeTabletHand(const TabletNode& node, double halfWidth, const Vec3& start, OpenInput open);

}  // namespace reachlab::devices
