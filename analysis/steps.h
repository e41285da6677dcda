#pragma once
#include <span>

#include "analysis/analysis.h"

namespace reachlab::analysis {

// The steps of AnalysisBuilder::finish, in their order. The trials lie sorted by condition and subject.

std::span<AnalyzedTrial> trialsOf(Analysis& analysis, std::size_t condition);
/// The prediction is that of every trial of the condition. The torques of an arm depend on the direction, so (2) needs a single target.
bool holdsFor(const Condition& condition, predict::Criterion criterion);
/// The samples of a used trial for the fits, with weights 1.
FitWindow windowOf(const Analysis& analysis, const AnalyzedTrial& trial);
/// The trials that a person's fits are parallel to.
std::vector<const AnalyzedTrial*> fittedTrials(const Analysis& analysis, const PersonResult& person);
/// Enters one trial into its condition's counts.
void countTrial(const AnalyzedTrial& trial, ConditionResult& result);
/// The paper's epsilon of each criterion over the trials of one condition, hand or object: over all samples, with intervals over people.
/// It describes the movements. Conclusions come from the fits.
EpsilonTable makeEpsilonTable(std::span<const AnalyzedTrial> trials, std::size_t criteria, bool object);
/// Means, predictions and the paper's epsilon of a condition.
void summarise(Analysis& analysis, std::size_t condition);
/// Fits each person's trials of a condition, and concludes from them.
void fitPeople(Analysis& analysis, std::size_t condition, const FittingProgress& progress);
/// Over all conditions: the candidates that every condition with fits has.
void concludeTogether(Analysis& analysis);

}  // namespace reachlab::analysis
