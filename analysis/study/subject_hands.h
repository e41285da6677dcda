#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::study {

/// The hand of one subject for one block of a day. `learnt` is the subject's memory from block to block. It is null at first, and the hand
/// reads and updates it.
using SubjectHands = std::function<std::unique_ptr<haptics::HapticDevice>(std::uint64_t seed, int day, std::shared_ptr<void>& learnt)>;

/// Makes plan and gains once for all subjects of a block, whose scenes these are. Devices are a layer above the study, so the caller
/// provides this function.
/// `device`: "simulated:KEY=VALUE,…". Throws FaultError, RefusedError (the subject cannot plan this movement).
using PrepareSubjects = std::function<SubjectHands(const std::string& device, std::span<const experiment::CompiledExperiment> scenes)>;

}  // namespace reachlab::study
