#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "sim/haptics/device.h"
#include "sim/predict/predict.h"

namespace reachlab::devices {

/// A virtual subject: plans by a criterion for this very object (reach_plan.h) and carries the plan out with motor noise.
struct SubjectSpec {
  double noise = 1;       // scales all of the below; 0: the plan itself, the same in each trial
  double timeSd = 0.07;   // movement time: the plan is run through faster or slower by a factor 1 + timeSd z (paper: 0.09 of 1.35 s)
  double speedSd = 0.07;  // smooth noise proportional to speed, as a part of it, along the path and across
  double reaction = 0.2;  // [s] from go to the first movement, 15 % SD
  std::optional<predict::Criterion> criterion;  // nullopt: minimum hand jerk; only straight ways are planned by a criterion
  std::optional<double> handMass;               // [kg] for the criterion; nullopt: the experiment's
};

/// Reads `noise=0,criterion=min-hand-force-change,hand-mass=1,time-sd=0.07,speed-sd=0.07,reaction=0.2` (all optional). Throws FaultError.
SubjectSpec parseSubject(const std::string& text);

/// One subject's hand for one block of a day. `learnt`: what the subject keeps from block to block, null at first.
using MakeSubject = std::function<std::unique_ptr<haptics::HapticDevice>(std::uint64_t seed, int day, std::shared_ptr<void>& learnt)>;

/// What all subjects of that kind share, the plan first of all, is made here, once; any thread may then make hands, several at a time.
/// Throws FaultError, RefusedError from the plan.
MakeSubject prepareSubjects(const experiment::CompiledExperiment& experiment, const SubjectSpec& subject);

/// Throws FaultError, RefusedError from the plan. Trial i is a function of (seed, i) alone.
std::unique_ptr<haptics::HapticDevice> makeSimulatedHand(const experiment::CompiledExperiment& experiment, const SubjectSpec& subject,
                                                         std::uint64_t seed);

}  // namespace reachlab::devices
