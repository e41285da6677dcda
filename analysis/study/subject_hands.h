#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::study {

/// The hand of one subject for one block of a day. `learnt`: what the subject keeps from block to block, null at first; the hand takes it up and leaves
/// it there.
using SubjectHands = std::function<std::unique_ptr<haptics::HapticDevice>(std::uint64_t seed, int day, std::shared_ptr<void>& learnt)>;

/// Makes what is alike in all subjects of an experiment (the plan, gains), once. Devices stand above the study, so whoever starts it brings
/// this. `device`: "simulated:KEY=VALUE,…". Throws FaultError, RefusedError (the subject cannot plan this movement).
using PrepareSubjects = std::function<SubjectHands(const std::string& device, const experiment::CompiledExperiment& experiment)>;

}  // namespace reachlab::study
