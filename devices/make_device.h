#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "devices/mapping/guarded_device.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// Makes the device that `NAME[:ARGUMENT]` names, for this experiment, or of `A + B` one for each hand (hands/several_hands.h); `deviceDrivers` (registry.h) has all that there are. Of a virtual
/// hand, trial i depends on (seed, i) alone. Throws FaultError (unknown name, key or value, a file that cannot be understood),
/// ResourceError (no such file, the device cannot be had), RefusedError (the subject cannot plan this movement).
std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::CompiledExperiment& experiment,
                                                  std::uint64_t seed);
/// Checks and compiles the experiment first.
std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::Experiment& experiment, std::uint64_t seed);

/// What is asked of the device beside its driver's own options: mapping and guards (docs/devices.md). Throws FaultError.
HandOptions handOptionsOf(const std::string& spec);

/// Trials of a run that is not told how many: a replayed source offers each of its reaches once, every other device one. Throws
/// ResourceError when there is nothing to replay.
int trialsOnOffer(const std::string& spec);

}  // namespace reachlab::devices
