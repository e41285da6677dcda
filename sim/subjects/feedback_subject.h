#pragma once
#include <optional>
#include <string>

#include "sim/subjects/feedback_gains.h"
#include "sim/subjects/model_learner.h"
#include "sim/subjects/plans/simulated_hand.h"

namespace reachlab::subjects {

/// A subject of `kind=ofc`: optimal feedback control with signal-dependent noise, delayed senses and an internal model of arm and object.
/// The model may be wrong. Its error is drawn for each trial and learnt (docs/virtual-subjects.md). The defaults are those of
/// subject_parameters.h.
struct FeedbackSpec {
  ArmSpec arm;
  SenseSpec senses;
  double motorNoise = 0, forceNoise = 0;  // s_u [1], s_a [N]
  double effort = 0, criterionEffort = 0, criterionWeight = 0;
  std::optional<predict::Criterion> criterion;         // nullopt: effort alone
  double timeSd = 0, reaction = 0;                     // [1], [s]
  ModelError planSd;                                   // from trial to trial, for a practised subject
  double practice = 0, practiceTrials = 1;             // SD is larger by a factor 1 + practice exp(-n / practiceTrials)
  ModelError first;                                    // theta_0
  LearningRates learning;                              // of the object
  LearningRates environment{0.21, 0.59, 0.02, 0.992};  // of a field on the hand and of a cursor's angle
  double noiseScale = 1;                               // factor on this person's noise, senses and planSd
  bool drawn = false;                                  // this person is drawn from the seed
  double noise = 1;                                    // factor on every draw; 0: the mean reach
};

/// Reads `criterion=effort|…,subject=1…5|drawn,sight=none|ends|all` and the numbers of feedbackParameters(). Throws FaultError.
FeedbackSpec parseFeedbackSubject(const std::string& text);

/// Throws FaultError. Throws RefusedError for a surface, a criterion that this arm cannot follow, or an object without a form on a line.
MakeSubject prepareFeedbackSubjects(const experiment::CompiledExperiment& experiment, const FeedbackSpec& spec);

}  // namespace reachlab::subjects
