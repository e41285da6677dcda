#pragma once
#include <string>
#include <vector>

#include "analysis/dataset.h"
#include "base/math/vec3.h"
#include "sim/record/log/run_log.h"

/// Objects that several hands move together: the measures of each hand, and how the hands share the work.
namespace reachlab::analysis {

/// One hand in one trial, over the movement (the task's own window).
struct HandMeasures {
  double peakSpeed = 0;                 // [m/s]
  double path = 0;                      // [m]
  double peakForce = 0, meanForce = 0;  // [N] coupling force on the object
  double work = 0;                      // [J] done on the object from arming to the trial's end
  double positiveWork = 0;              // [J] the sum of what it has put in, without what it has taken out, over the movement
  double share = 0;                     // of the positive work of all; NaN where there is none
  // [s] behind the first hand, by the largest correlation of their speeds within half a second. NaN: not measured
  double lag = 0;
  double lagCorrelation = 0;  // there
};
struct TogetherMeasures {
  std::vector<HandMeasures> hands;
  double internalForce = 0;      // [N] RMS of what cancels: half of (sum of |F_i| - |sum of F_i|)
  double peakInternalForce = 0;  // [N]
};

/// Places, speeds and forces of one hand, evenly sampled.
struct HandSignals {
  std::vector<Vec3> place, velocity, force;  // [m], [m/s], [N] on the object
  std::vector<double> work;                  // [J] so far
};
/// `rate` [Hz]. All signals of one length.
TogetherMeasures measureTogether(const std::vector<HandSignals>& hands, double rate);

/// True if several hands hold the object in any condition.
bool hasSeveralHands(const DatasetIndex& dataset);
/// A row for each hand of each trial with a movement, in the analysed runs in which several hands hold the object. Empty without such a run.
/// Only their logs are opened again. Throws ResourceError.
std::string handsTable(const DatasetIndex& dataset);

}  // namespace reachlab::analysis
