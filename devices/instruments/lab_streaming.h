#pragma once
#include <memory>

#include "devices/instruments/instrument.h"

namespace reachlab::devices {

/// Lab Streaming Layer by its library liblsl, found when the program runs: a stream of markers ("go", "onset", "success", with the trial's number),
/// and one of the hand at every tick (position in m, velocity in m/s), both under the tick's own time in LSL's clock. The offset of that clock
/// from the computer's monotonic one is noted at each run's begin and end. Throws ResourceError when the library cannot be had.
std::unique_ptr<Instrument> openLabStreaming(const std::string& name);

}  // namespace reachlab::devices
