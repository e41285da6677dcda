#pragma once
#include <optional>
#include <string>

#include "sim/subjects/arm_world.h"
#include "sim/subjects/plans/simulated_hand.h"

namespace reachlab::subjects {

/// A subject of `kind=impedance`: an arm with mass and muscle that follows the plan of a criterion for the present object. An inverse of
/// arm and object, as the subject knows them, gives the force that the plan needs. The muscle gets this force with noise in proportion to
/// it. The arm's stiffness and damping act at once. A further correction comes after the delay of a reflex (Razavian et al. 2023 weigh the
/// same parts). The subject feels the coupling's force. The defaults are those of subject_parameters.h.
struct ImpedanceSpec {
  ArmSpec arm;
  double stiffness = 0, damping = 0;                  // [N/m], [N s/m] at once
  double feedbackStiffness = 0, feedbackDamping = 0;  // the same through the muscle, delayed
  double delay = 0;                                   // [s]
  double motorNoise = 0, forceNoise = 0;              // s_u [1], s_a [N] in 10 ms
  ModelError model;                                   // error of the object model in the inverse
  std::optional<predict::Criterion> criterion;
  std::optional<double> handMass;   // [kg] in the criterion
  double timeSd = 0, reaction = 0;  // [1], [s]
  double noise = 1;                 // factor on every draw
};

/// Reads `criterion=…` and the numbers of impedanceParameters(). Throws FaultError.
ImpedanceSpec parseImpedanceSubject(const std::string& text);

/// Throws FaultError. Throws RefusedError from the plan.
MakeSubject prepareImpedanceSubjects(const experiment::CompiledExperiment& experiment, const ImpedanceSpec& spec);

}  // namespace reachlab::subjects
