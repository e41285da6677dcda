#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sim/haptics/device.h"

namespace reachlab::devices {

/// The devices of one line, `simulated + mouse`: one for each hand, in the order of the experiment's hands.
std::vector<std::string> splitHands(const std::string& spec);
/// The line of several devices.
std::string joinHands(const std::vector<std::string>& specs);

/// Several devices as one, in the first one's name: cues, calibration, health and the second path go to all. A hand that is simulated for one
/// of them moves by tick count only if all are. Only the first may drive the clock; throws FaultError for another.
std::unique_ptr<haptics::HapticDevice> joinDevices(std::vector<std::unique_ptr<haptics::HapticDevice>> devices);

}  // namespace reachlab::devices
