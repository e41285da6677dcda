#pragma once
#include <map>
#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// A person's trials that can teach, in their order: every trial with a movement, also of practice, without catch trials.
struct TaughtTrials {
  std::vector<const AnalyzedTrial*> trials;
  bool rotated = false, fielded = false;  // a cursor was rotated; a trained field acted
};
/// By subject. Only people whom a field or a rotation perturbed. The analysis outlives the result.
std::map<std::string, TaughtTrials> taughtTrials(const Analysis& analysis);

}  // namespace reachlab::analysis
