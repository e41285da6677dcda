#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/predict/prediction/criterion.h"
#include "sim/subjects/arm_world.h"

namespace reachlab::subjects {

/// The positions that a subject sees.
enum class Sight { None, Ends, All };  // Ends: hand and last mass; All: hand and every mass

struct SenseSpec {
  double position = 0.01, velocity = 0.1, force = 0.6;  // [m], [m/s], [N] SD of touch in a control step
  double seen = 0.004;                                  // [m] SD of a seen position
  int touchDelay = 5, sightDelay = 10;                  // [control steps], 1 or more
  Sight sight = Sight::Ends;
};

/// The cost of a reach: the task's tolerances at rest at the target, effort, and a criterion along the path.
struct CostSpec {
  double distance = 0.2, duration = 1.35, hold = 0.8;  // [m], [s], [s] gains after the movement's end; constant afterwards
  double position = 0.012, velocity = 0.012;           // [m], [m/s] tolerances
  double effort = 0.03;                                // [1/N^2] r
  std::optional<predict::Criterion> criterion;
  double criterionWeight = 0;  // w_c
};

inline constexpr double kControlStep = 0.01;  // [s] D

/// Gains of optimal feedback control with signal-dependent noise, and of the Kalman filter over state and delayed senses. Source: Todorov
/// 2005, without the term that couples the estimator's error into the cost. The senses are z = [x; touch of the last steps, newest first;
/// sight likewise]. They are made before a trial, as flat arrays, so that the tick only adds and multiplies.
struct FeedbackGains {
  int states = 0, touch = 3, sight = 0, touchDelay = 0, sightDelay = 0, steps = 0;
  int estimate() const { return states + touch * touchDelay + sight * sightDelay; }
  int senses() const { return touch + sight; }
  std::vector<double> control;  // [step][state]: u = -control x
  std::vector<double> filter;   // [step][sense][estimate]
  std::vector<double> advance;  // A, column by column
  std::vector<double> command;  // b
  std::vector<double> felt;     // [touch][state]
  std::vector<int> seen;        // state of each seen position
};

/// `motorNoise` and `forceNoise`: s_u and s_a [N]. Throws RefusedError for a criterion that this muscle cannot follow.
FeedbackGains computeFeedbackGains(const ArmWorld& world, const ArmSpec& arm, const CostSpec& cost, const SenseSpec& senses,
                                   double motorNoise, double forceNoise);

/// The row c of a criterion's integrand (c x)^2. `totalMass` is that of hand and object. Throws RefusedError.
Eigen::RowVectorXd criterionRow(const ArmWorld& world, const ArmSpec& arm, double totalMass, predict::Criterion criterion);

}  // namespace reachlab::subjects
