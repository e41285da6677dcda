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

/// The numbers of one person's learning. The training is from the first perturbed trial to the last. Deviations are the largest to the
/// right [m] in a field, and hand angles [degrees] under a rotation. Those before the training are taken off.
struct Learning {
  double plateau = kNotMeasured;  // [%] of the perturbation that is cancelled: channel trials, or rotated trials, of the last quarter
  double first = kNotMeasured;    // deviation in the first five perturbed trials
  double last = kNotMeasured;     // deviation in the perturbed trials of the last quarter
  double afterEffect =
      kNotMeasured;  // deviation in the first five unperturbed trials after the training, else in those of the last quarter
};
Learning learningOf(const TaughtTrials& person);

}  // namespace reachlab::analysis
