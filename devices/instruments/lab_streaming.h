#pragma once
#include <memory>

#include "devices/instruments/instrument.h"

namespace reachlab::devices {

/// Lab Streaming Layer through the library liblsl, which is loaded while the program runs. One stream has the markers ("go", "onset",
/// "success", "end") with the trial's number. Another stream has the hand at every tick (position in m, velocity in m/s). Both have the
/// time of the tick in LSL's clock. The offset of that clock from the computer's monotonic clock is noted at each run's begin and end.
/// Throws ResourceError when the library cannot be loaded.
std::unique_ptr<Instrument> openLabStreaming(const std::string& name);

}  // namespace reachlab::devices
