#pragma once
#include <memory>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// How a simulated person behaves who moves an object together with another.
enum class PartnerRole {
  Leader,    // carries out a reach of its own from the go signal on, like a subject alone
  Follower,  // has no plan: moves to where it sees the object, one reaction time ago
  Stubborn,  // means to stay at the start
};

struct PartnerSpec {
  PartnerRole role = PartnerRole::Leader;
  int mass = 0;            // that it sees: from 1; 0: the last
  double handMass = 1;     // [kg]
  double stiffness = 300;  // [N/m] of the arm about where it means to be
  double damping = 20;     // [N s/m]
  double reaction = 0.15;  // [s] of a follower
};

/// A hand as a body that feels the object's force: m x'' = F + k (p - x) + b (p' - x'), with p where the role means to be. By tick count,
/// without noise but the leader's own (`subject`), which depends on (seed, trial) alone. Semi-implicit Euler at 0.1 ms.
/// `leader`: the hand whose motion a leader means to make; not asked for by the others.
std::unique_ptr<haptics::HapticDevice> makePartnerHand(const experiment::CompiledExperiment& experiment, const PartnerSpec& spec,
                                                       std::unique_ptr<haptics::HapticDevice> leader);

}  // namespace reachlab::devices
