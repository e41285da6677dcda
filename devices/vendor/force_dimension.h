#pragma once
#include <memory>
#include <string>

#include "devices/io/polled_device.h"

namespace reachlab::devices {

/// The `index`-th device of Force Dimension's library. `words` is its name in messages ("device forcedimension:0"). Throws ResourceError
/// with the library's message.
std::shared_ptr<Transport> openForceDimension(int index, const std::string& words, bool deviceVelocity);

}  // namespace reachlab::devices
