#pragma once
#include <optional>
#include <string>

#include "devices/simulated/simulated_hand.h"
#include "devices/subject/arm_world.h"

namespace reachlab::devices {

/// A subject of `kind=impedance`: the plan of a criterion for the object that is there, followed by an arm with mass and muscle. The muscle gets
/// the force that the plan needs by an inverse of arm and object as the subject knows them, with noise in proportion to it; the arm's
/// stiffness and damping to the plan are felt at once, a further correction by the delay of a reflex (Razavian et al. 2023 weigh the same
/// parts). It feels the coupling's force. Defaults are those of subject_parameters.h.
struct ImpedanceSpec {
  ArmSpec arm;
  double stiffness = 0, damping = 0;                  // [N/m], [N s/m] felt at once
  double feedbackStiffness = 0, feedbackDamping = 0;  // the same by way of the muscle, delayed
  double delay = 0;                                   // [s]
  double motorNoise = 0, forceNoise = 0;              // s_u [1], s_a [N] in 10 ms
  ModelError model;                                   // of the object that the inverse knows
  std::optional<predict::Criterion> criterion;
  std::optional<double> handMass;   // [kg] in the criterion
  double timeSd = 0, reaction = 0;  // [1], [s]
  double noise = 1;                 // of every draw
};

/// Reads `criterion=…` and the numbers of impedanceParameters(). Throws FaultError.
ImpedanceSpec parseImpedanceSubject(const std::string& text);

/// Throws FaultError, RefusedError from the plan.
MakeSubject prepareImpedanceSubjects(const experiment::CompiledExperiment& experiment, const ImpedanceSpec& spec);

}  // namespace reachlab::devices
