#pragma once
#include <memory>

#include "sim/haptics/device.h"

namespace reachlab::haptics::test {

/// A device of the test, which outlives the loop that it is lent to.
inline std::shared_ptr<HapticDevice> borrowed(HapticDevice& device) { return {std::shared_ptr<void>(), &device}; }

}  // namespace reachlab::haptics::test
