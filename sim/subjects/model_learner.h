#pragma once
#include <vector>

#include "sim/subjects/feedback_gains.h"

namespace reachlab::subjects {

/// The commands and senses of a subject in one trial, one per control step. Memory for the longest trial is reserved beforehand.
struct TrialTrace {
  std::vector<double> command;  // [step] u before its noise
  std::vector<double> sensed;   // [step][sense] as they arrived, delayed and noisy
  int steps = 0;
};

/// The memory from trial to trial: two processes (Smith et al. 2006).
struct LearntModel {
  ModelError first, fast, slow;
  int trials = 0, day = 0;
  ModelError current() const { return {first.stiffness + fast.stiffness + slow.stiffness, first.mass + fast.mass + slow.mass}; }
};

struct LearningRates {
  double learnFast = 0, keepFast = 0, learnSlow = 0, keepSlow = 1;
};

/// The Gauss-Newton step that makes the trial's senses less surprising, from the model that was used: -(1.05 J'J + 20 I)^-1 J' r. The
/// innovations r are in units of their SD. Each component is limited to 0.3. `worldOf` makes arm and object for a model.
ModelError computeModelStep(const FeedbackGains& gains, const TrialTrace& trace, const ModelError& used, const ArmSpec& arm,
                            const predict::LineObject& object, const SenseSpec& senses, double distance);
/// Decays both processes and adds the step.
void learn(const LearningRates& rates, const ModelError& step, LearntModel& model);

}  // namespace reachlab::subjects
