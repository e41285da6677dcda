#pragma once
#include <vector>

#include "sim/analyze/study.h"

namespace reachlab::analyze {

/// Enters one trial into its condition's counts; `results` grows to `conditions`.
void countTrial(const TrialData& data, const StudyTrial& trial, std::size_t conditions, std::vector<ConditionResult>& results);

/// Table 2: successes by subject, day and condition over the trials that ended as success or failure; aborted and interrupted ones are
/// no attempts. `trials` sorted as in StudyResult.
std::vector<SuccessCell> successTable(const std::vector<StudyTrial>& trials);

/// Success over consecutive groups of `bin` counted trials of one subject and condition; a group never spans two sessions.
std::vector<LearningPoint> learningCurves(const std::vector<StudyTrial>& trials, int bin);

}  // namespace reachlab::analyze
