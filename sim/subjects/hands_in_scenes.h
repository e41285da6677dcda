#pragma once
#include <memory>
#include <vector>

#include "sim/haptics/device.h"

namespace reachlab::subjects {

/// One virtual hand for each scene of a block as one device. It does each trial with the hand of the trial's scene, from Cue::Place on. The
/// hand of the trial before is prepared as well, so that it learns from that trial even if it does not do the next. The hands are alike in
/// their DeviceInfo.
std::unique_ptr<haptics::HapticDevice> joinScenes(std::vector<std::unique_ptr<haptics::HapticDevice>> hands);

}  // namespace reachlab::subjects
