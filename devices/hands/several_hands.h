#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sim/haptics/device.h"

namespace reachlab::devices {

/// The devices of one text `simulated + mouse`: one device for each hand, in the order of the experiment's hands.
std::vector<std::string> splitHands(const std::string& spec);
/// The text that names several devices.
std::string joinHands(const std::vector<std::string>& specs);

/// Several devices as one device, under the name of the first. Cues, calibration, health and the second way to stop the force go to all of
/// them. If one hand's motion is simulated, it moves by tick count only if all hands do. Only the first device may drive the clock. Throws
/// FaultError if another device does.
std::unique_ptr<haptics::HapticDevice> joinDevices(std::vector<std::unique_ptr<haptics::HapticDevice>> devices);

}  // namespace reachlab::devices
