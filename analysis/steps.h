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
/// Means, predictions and the paper's epsilon of a condition.
void summarise(Analysis& analysis, std::size_t condition);
/// Fits each person's trials of a condition, and concludes from them.
void fitPeople(Analysis& analysis, std::size_t condition, const FittingProgress& progress);
/// Over all conditions: the candidates that every condition with fits has.
void concludeTogether(Analysis& analysis);

}  // namespace reachlab::analysis
