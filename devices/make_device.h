#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "devices/mapping/guarded_device.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// Makes the device that `NAME[:ARGUMENT]` names, for this experiment. `A + B` makes one device for each hand (hands/several_hands.h).
/// `deviceDrivers` (registry.h) lists all devices. For a virtual hand, trial i depends on (seed, i) alone. Throws FaultError (unknown name,
/// key or value, an unreadable file), ResourceError (no such file, the device cannot be opened) or RefusedError (the subject cannot plan
/// this movement).
std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::CompiledExperiment& experiment,
                                                  std::uint64_t seed);
/// The same for the scenes of a block. A virtual hand does each trial in the scene of its number. Real devices take the first scene. Where a
/// block has several scenes, `learnt` keeps what the virtual person of one hand learns, from block to block.
std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, std::span<const experiment::CompiledExperiment> scenes,
                                                  std::uint64_t seed, std::shared_ptr<void>* learnt = nullptr);
/// Checks and compiles the experiment first.
std::unique_ptr<haptics::HapticDevice> makeDevice(const std::string& spec, const experiment::Experiment& experiment, std::uint64_t seed);

/// The hand, sampled by the computer's clock, if its kind may drive the clock and the text does not choose. Otherwise unchanged.
std::string byComputersClock(const std::string& hand);

/// The options of a device besides its driver's options: mapping and guards (docs/devices.md). Throws FaultError.
HandSettings handSettingsOf(const std::string& spec);

/// The number of trials when a run names none: as many as a replayed source has reaches, one for every other device. Throws ResourceError
/// when the source has no reach.
int trialsOnOffer(const std::string& spec);

}  // namespace reachlab::devices
