#pragma once
#include <span>
#include <string_view>

#include "analysis/measures/movement.h"
#include "analysis/trials/trial_data.h"

namespace reachlab::analysis {

struct MeasureOptions {
  OnsetOptions onset;
  double cutoff = 10;  // [Hz] of the zero-lag Butterworth on the hand's velocity; 0: none
};

/// The measures of one trial. A measure that does not exist is NaN, for example without a movement. `measures` explains each number.
struct TrialMeasures {
  bool beforeGo = false;                                                // the hand left before the go signal
  double reactionTime = kNotMeasured;                                   // [s] go signal to onset; none where the hand left before it
  double onset = kNotMeasured, offset = kNotMeasured;                   // [s] since arming
  double duration = kNotMeasured;                                       // [s] onset to offset
  double movementTime = kNotMeasured;                                   // [s] the task's own: t_e
  double peakSpeed = kNotMeasured;                                      // [m/s] of the hand
  double timeToPeak = kNotMeasured;                                     // [s] from onset
  double timeToPeakPercent = kNotMeasured;                              // [%] of the duration
  double symmetryRatio = kNotMeasured;                                  // time to peak / time from peak to offset
  double pathLength = kNotMeasured;                                     // [m] of the hand, onset to offset
  double speedPeaks = kNotMeasured;                                     // local maxima of the hand's speed
  double handEndpointError = kNotMeasured;                              // [m] hand's displacement at offset against the asked one
  double objectEndpointError = kNotMeasured;                            // [m] last mass to target at the trial's end
  double handOvershoot = kNotMeasured, objectOvershoot = kNotMeasured;  // [m] farthest beyond the target, straight tasks only, >= 0
  double sparc = kNotMeasured, ldlj = kNotMeasured;
  double peakForce = kNotMeasured, meanForce = kNotMeasured;  // [N] coupling force
  // Across the way (across.h).
  double maxPerpendicular = kNotMeasured, perpendicularAtPeakSpeed = kNotMeasured;  // [m]
  double handAngle = kNotMeasured, handAngleAtRadius = kNotMeasured;                // [degrees]
  double channelLeak = kNotMeasured;                                                // [m]
  double adaptation = kNotMeasured, adaptationR2 = kNotMeasured;                    // [%], [1]
};

/// One measure of a trial. Tables, their dictionaries, studies and the report follow from `measures`. The measures of the haptic ticks
/// are in sim/record/log/trial_measures.h, under other names.
struct Measure {
  std::string_view name;         // with its unit, as in every table
  std::string_view sentence;     // of every dictionary
  double TrialMeasures::*value;  // in the unit of the name
  std::string_view label;        // of the report, with the unit that it is shown in
  double scale = 1;              // from the name's unit to the label's
  int digits = 3;                // behind the point, in the report
};
std::span<const Measure> measures();

/// A trial's filtered signals. Profiles and errors are made of them.
struct TrialSignals {
  Movement movement;                   // of the hand, in seconds since sample 0; ends with the trial at the latest
  std::vector<double> speed;           // [m/s] of the hand, >= 0
  std::vector<double> handVelocity;    // [m/s] along the path, signed where the path has a direction
  std::vector<double> objectVelocity;  // [m/s] the same of the last mass
  /// On a closed curve the hand went round the other way: both velocities above are along the path of the hand.
  bool otherWay = false;
};

TrialSignals computeSignals(const TrialData& trial, const MeasureOptions& options);
TrialMeasures computeMeasures(const TrialData& trial, const TrialSignals& signals);

}  // namespace reachlab::analysis
