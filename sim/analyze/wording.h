#pragma once
#include <string>
#include <vector>

#include "sim/analyze/study.h"

namespace reachlab::analyze {

/// Sentences of the report, as they also go to the terminal. Plain text, no mark-up.

/// Which criterion is nearest, and which cannot be told from it. `criteria` is what the places index.
std::string describeRanking(const Ranking& ranking, const std::vector<predict::Criterion>& criteria);
/// How onset and offset were found and profiles made.
std::string describeMethods(const StudyOptions& options);
/// What went into a condition and what did not: "18 of 20 trials succeeded …".
std::string describeCounts(const ConditionResult& result);
/// Empty, or a warning that the movements last otherwise than the predictions that they are compared with.
std::string describeDurations(const ConditionResult& result);

/// The criteria that a condition's ranking indexes.
std::vector<predict::Criterion> criteriaOf(const ConditionResult& result);
/// A number with three significant digits and a real minus sign.
std::string shortNumber(double value);

}  // namespace reachlab::analyze
