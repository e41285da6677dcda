#pragma once
#include <memory>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::subjects {

/// The role of a simulated person who moves an object together with another person.
enum class PartnerRole {
  Leader,    // carries out a planned reach from the go signal on, like a subject alone
  Follower,  // has no plan: moves to where it saw the object one reaction time ago
  Stubborn,  // means to stay at the start
};

struct PartnerSpec {
  PartnerRole role = PartnerRole::Leader;
  int mass = 0;            // number of the mass that it sees, from 1; 0: the last mass
  double handMass = 1;     // [kg]
  double stiffness = 300;  // [N/m] of the arm about its intended position
  double damping = 20;     // [N s/m]
  double reaction = 0.15;  // [s] of a follower
};

/// A hand as a body that feels the object's force: m x'' = F + k (p - x) + b (p' - x'). The role sets the intended position p. The motion
/// is by tick count. Its only noise is the leader's (`subject`), which depends on (seed, trial) alone. Semi-implicit Euler at 0.1 ms.
/// `leader` is the hand whose motion a leader means to make. The other roles do not ask it.
std::unique_ptr<haptics::HapticDevice> makePartnerHand(const experiment::CompiledExperiment& experiment, const PartnerSpec& spec,
                                                       std::unique_ptr<haptics::HapticDevice> leader);

}  // namespace reachlab::subjects
