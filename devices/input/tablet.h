#pragma once
#include <functional>
#include <memory>

#include "devices/input/event_node.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

using OpenInput = std::function<std::unique_ptr<InputPort>()>;  // throws ResourceError while the tablet is not present

/// A pen on a tablet. The position of the pen is the position of the hand in the plane of x and y. The distance from the middle to the
/// right edge is `halfWidth` [m]. Events are played back by their own times, as those of the mouse are (mouse_device.h).
std::unique_ptr<haptics::HapticDevice> makeTabletHand(const TabletNode& node, double halfWidth, const Vec3& start, OpenInput open);

}  // namespace reachlab::devices
