#pragma once
#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// Sentences of the report, as they also go to the terminal. Plain text, no mark-up.

/// A candidate as it is named: "(1) min-hand-jerk", "(4) min-hand-force (the same prediction as (6) min-com-acceleration)", or "a
/// minimum jerk that ignores the object".
std::string describeCandidate(const std::vector<predict::Criterion>& criteria);

/// The one plain sentence. It names the criterion with its certainty, or says that nothing may be concluded, with the reason.
std::string describeConclusion(const Conclusion& conclusion, const std::vector<std::vector<predict::Criterion>>& candidates);
/// The numbers beside every conclusion: trials, the least certain comparison, exceedance, R^2 and its ceiling.
std::string describeEvidence(const Conclusion& conclusion, const std::vector<std::vector<predict::Criterion>>& candidates);
/// The conditions that the overall conclusion is over, and the conditions that are left out. Empty with one condition.
std::string describeTogether(const Analysis& analysis);
/// Hand masses and time laws that were tried, and how often each was chosen for the candidate that is closest.
std::string describeChoices(const Analysis& analysis, const std::vector<std::size_t>& conditions,
                            const std::vector<predict::Criterion>& criteria);

/// A sentence for each field or rotation that people were trained in: plateau, after-effect with its side, and number of people. Empty
/// where nobody was.
std::string describeLearning(const Analysis& analysis);

/// The methods paragraph, ready to be pasted: every option that changes numbers.
std::string describeMethods(const Analysis& analysis);
/// The limits of the conclusions.
std::string describeLimits(const Analysis& analysis);
/// The counts of a condition's trials: "18 of 20 trials succeeded …".
std::string describeCounts(const ConditionResult& result);
/// An effect on success: "D2 − D1, chain-slow: +21 points [5, 37] …".
std::string describeEffect(const Analysis& analysis, const Effect& effect);
std::string describeSlope(const Analysis& analysis, const LearningSlope& slope);

/// A number with three significant digits and a real minus sign.
std::string shortNumber(double value);
/// A share with Clopper and Pearson's interval: "4 % [0.1, 20]".
std::string shareText(std::size_t part, std::size_t of);
/// "1 trial", "2 trials".
std::string plural(std::size_t n, const std::string& noun);
/// p as text: "p = 0.012", "p < 0.0001".
std::string pText(double p);

}  // namespace reachlab::analysis
