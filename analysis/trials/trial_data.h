#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/math/vec3.h"
#include "sim/experiment/environment.h"
#include "sim/trial/outcome.h"

namespace reachlab::analysis {

inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// The subject, the session and the series of a trial.
struct TrialKey {
  std::string subject, session, condition;
  int day = 0;  // from the plan, else the session's place among the subject's sessions, from 1
  int run = 0, block = 0, trial = 0;
  std::string kind = {}, target = {};  // of a block that mixes them
};
/// The order of one subject's trials: by day, session, run and number.
bool recordedBefore(const TrialKey& a, const TrialKey& b);

/// The part of a trial's scene that measures across the way need (measures/deviation_and_adaptation.h).
struct TrialScene {
  Vec3 normal{0, 1, 0};                                // of the task's plane
  bool channel = false;                                // a channel holds the hand on the line
  bool otherForce = false;                             // besides the channel
  bool inField = false;                                // a viscous field acts, of the hand or of the joints
  double strength = 0;                                 // of that field relative to the trained field; the opposite field has -1
  bool cursor = false;                                 // the hand is not seen where it is
  std::optional<double> clamp;                         // [degrees] of the line of the cursor, whatever the hand does
  double rotation = 0;                                 // [degrees] of the cursor
  std::optional<experiment::SquareMatrix<3>> trained;  // [N s/m] of the viscous field that is trained
};

/// Facts of a trial other than its samples.
struct TrialFacts {
  TrialKey key;
  bool practice = false, catchTrial = false;
  trial::TrialResult result;
  TrialScene scene;
};

/// One recorded trial as plain arrays, evenly sampled from arming to its end. Sample i is at first + i / rate after arming. Nothing is
/// filtered.
struct TrialData : TrialFacts {
  double rate = 100;                                          // [Hz]
  double first = 0;                                           // [s] of sample 0 since arming, below 1 / rate
  double goTime = kNotMeasured;                               // [s] go signal, since arming like all times here
  double taskOnset = kNotMeasured, taskEnd = kNotMeasured;    // [s] the task's own window: t = 0 and t_e (or where it was broken off)
  std::vector<Vec3> hand;                                     // [m] HIP as the coupling saw it
  std::vector<Vec3> velocity;                                 // [m/s] of the hand, as it was estimated and recorded
  std::vector<Vec3> environment;                              // [N] on the hand; empty where no force acts on it
  std::vector<Vec3> object;                                   // [m] last mass; the hand, where there is no object
  std::vector<Vec3> objectVelocity;                           // [m/s] of the simulation
  std::vector<double> force;                                  // [N] coupling force on the object
  double peakForce = kNotMeasured, meanForce = kNotMeasured;  // [N] over every tick, where the log has them
  /// Direction of the path: a single vector for a straight task, a vector per sample on a curve, empty on a surface (only speed is
  /// defined).
  std::vector<Vec3> along;
  bool closed = false;  // the path is a closed curve
  std::string notSeen;  // what is missing in the samples of the movement; empty: nothing
  // The experimenter's marks beside the recording (record/trial_marks.h).
  std::string excluded;                                            // why the trial is not to count; empty: it counts
  double markedOnset = kNotMeasured, markedOffset = kNotMeasured;  // [s] of the movement, in place of the rule's
  Vec3 start, target;                                              // [m] of the object
};

}  // namespace reachlab::analysis
