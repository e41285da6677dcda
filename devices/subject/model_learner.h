#pragma once
#include <vector>

#include "devices/subject/feedback_gains.h"

namespace reachlab::devices {

/// What a subject commanded and sensed in one trial, a control step each; made as large as a trial can be beforehand.
struct TrialTrace {
  std::vector<double> command;  // [step] u before its noise
  std::vector<double> sensed;   // [step][sense] as they came, delayed and noisy
  int steps = 0;
};

/// What is kept from trial to trial: two processes (Smith et al. 2006).
struct LearntModel {
  ModelError first, fast, slow;
  int trials = 0, day = 0;
  ModelError current() const { return {first.stiffness + fast.stiffness + slow.stiffness, first.mass + fast.mass + slow.mass}; }
};

struct LearningRates {
  double learnFast = 0, keepFast = 0, learnSlow = 0, keepSlow = 1;
};

/// The step of Gauss and Newton that makes the trial's senses less surprising, from the model that was used: -(1.05 J'J + 20 I)^-1 J' r over
/// the innovations in units of their SD, each component within 0.3. `worldOf` makes arm and object for a model.
ModelError computeModelStep(const FeedbackGains& gains, const TrialTrace& trace, const ModelError& used, const ArmSpec& arm,
                            const predict::LineObject& object, const SenseSpec& senses, double distance);
/// Keeps what is kept, and adds the step.
void learn(const LearningRates& rates, const ModelError& step, LearntModel& model);

}  // namespace reachlab::devices
