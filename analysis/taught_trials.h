#pragma once
#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// A person's trials that can teach, in their order: every trial with a movement, also of practice, without catch trials.
struct TaughtTrials {
  std::string subject;
  bool rotated = false;  // by a rotated cursor, else by a field
  std::vector<const AnalyzedTrial*> trials;
  std::optional<experiment::SquareMatrix<3>> field;  // [N s/m] the first trained field, unless it is a field of the joints
  /// The strengths, relative to that field, of the field that a trial's block trains, and of the field that acts in the trial. The opposite field has
  /// the strength -1.
  double unitOf(const AnalyzedTrial& trial) const;
  double strengthIn(const AnalyzedTrial& trial) const { return trial.scene.strength * unitOf(trial); }
};
/// By subject, and of each subject the field before the rotation. A session with a rotation alone teaches no field, and the other way round. The
/// analysis outlives the result.
std::vector<TaughtTrials> taughtTrials(const Analysis& analysis);

/// The numbers of one person's learning. The training is from the first trial that is perturbed by the first trained field, or by a rotation, to the
/// last. Deviations are the largest to the right [m] in a field, and hand angles [degrees] under a rotation. Those before the training are taken
/// off. Trials that are left out, as practice is, do not count.
struct Learning {
  double plateau = kNotMeasured;  // [%] of the perturbation that is cancelled: channel trials, or rotated trials, of the last quarter
  double first = kNotMeasured;    // deviation in the first five perturbed trials
  double last = kNotMeasured;     // deviation in the perturbed trials of the last quarter
  double afterEffect =
      kNotMeasured;  // deviation in the first five unperturbed trials after the training, else in those of the last quarter
};
Learning learningOf(const TaughtTrials& person);

}  // namespace reachlab::analysis
