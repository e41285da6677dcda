#pragma once
#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// Another choice of the analysis that a referee could ask for, with all other choices as they are.
struct Alternative {
  std::string choice;  // "cut-off 6 Hz"
  AnalysisOptions options;
};

/// Other cut-offs, another onset rule, other ranges of the hand's mass, failed and practice trials, and each compared criterion left out.
/// Choices that `asked` has made are not in the list.
std::vector<Alternative> alternativesTo(const AnalysisOptions& asked);

/// The conclusion of each condition and of all together ("all"). `changed` is false.
std::vector<AlternativeConclusion> conclusionsOf(const Analysis& analysis, const std::string& choice);

/// Puts `others` into `analysis` behind its own conclusions, whose choice is "as asked". A conclusion has changed if it names another
/// criterion than that one, or none in place of one, or one in place of none.
void addAlternatives(Analysis& analysis, std::vector<AlternativeConclusion> others);

/// "The conclusion of all conditions is the same in 12 of 14 other analyses. …" with those that differ. Empty without alternatives.
std::string describeAlternatives(const Analysis& analysis);

/// alternatives.csv.
std::string alternativesTable(const Analysis& analysis);

}  // namespace reachlab::analysis
