#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/device_options.h"
#include "sim/haptics/device.h"
#include "sim/predict/predict.h"

namespace reachlab::subjects {

/// A virtual subject that plans by a criterion for this very object (reach_plan.h) and carries the plan out with motor noise.
struct SubjectSpec {
  double noise = 1;       // scales all numbers below; 0: the plan itself, the same in each trial
  double timeSd = 0.07;   // movement time: the plan runs faster or slower by a factor 1 + timeSd z (paper: 0.09 of 1.35 s)
  double speedSd = 0.07;  // smooth noise proportional to speed, as a share of it, along the path and across
  double reaction = 0.2;  // [s] from go to the first movement, 15 % SD
  std::optional<predict::Criterion> criterion = {};  // nullopt: minimum hand jerk; a criterion plans straight movements only
  std::optional<double> handMass = {};               // [kg] for the criterion; nullopt: the experiment's hand mass
};

/// Takes `noise=0,criterion=min-hand-force-change,hand-mass=1,time-sd=0.07,speed-sd=0.07,reaction=0.2` (all optional) out of a device's
/// options. Throws FaultError.
SubjectSpec takeSubject(DeviceOptions& options);

/// One subject's hand for one block of a day. `learnt` is the memory that the subject keeps from block to block. It is null at first.
using MakeSubject = std::function<std::unique_ptr<haptics::HapticDevice>(std::uint64_t seed, int day, std::shared_ptr<void>& learnt)>;

/// Makes once the parts that all subjects of that kind share, above all the plan. Then any thread may make hands, and several threads may
/// do so at once. Throws FaultError. Throws RefusedError from the plan.
MakeSubject prepareSubjects(const experiment::CompiledExperiment& experiment, const SubjectSpec& subject);

/// Throws FaultError. Throws RefusedError from the plan. Trial i is a function of (seed, i) alone.
std::unique_ptr<haptics::HapticDevice> makeSimulatedHand(const experiment::CompiledExperiment& experiment, const SubjectSpec& subject,
                                                         std::uint64_t seed);

}  // namespace reachlab::subjects
