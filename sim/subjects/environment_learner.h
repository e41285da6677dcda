#pragma once
#include "sim/subjects/model_learner.h"

namespace reachlab::subjects {

/// A subject's belief about the world beyond the object: a viscous field along and across the way, and the angle of the cursor.
struct EnvironmentModel {
  double along = 0, across = 0;  // [N s/m] force along the path and to the right of it, for each m/s along the way
  double angle = 0;              // [degrees] of the cursor, counterclockwise
};

/// The memory from trial to trial: two processes (Smith et al. 2006).
struct LearntEnvironment {
  EnvironmentModel fast, slow;
  EnvironmentModel current() const { return {fast.along + slow.along, fast.across + slow.across, fast.angle + slow.angle}; }
};

/// The errors of one trial, gathered while it runs: forces that the belief does not explain, against the speed along the path, and the
/// direction of the cursor at the largest speed. Haptic thread for `add` and `look`, which never allocate.
class EnvironmentTrace {
 public:
  /// `along`, `across`: unexplained force [N]; `speed` along the path [m/s].
  void add(double along, double across, double speed) noexcept;
  /// The cursor's direction [degrees] against that to the target, at a speed [m/s].
  void look(double degrees, double speed) noexcept;
  /// Least-squares coefficients of the unexplained forces, and the angle. Zero without a movement.
  EnvironmentModel error() const noexcept;

 private:
  double squares_ = 0, along_ = 0, across_ = 0, fastest_ = 0, angle_ = 0;
};

/// Decays both processes and adds the error.
void learn(const LearningRates& rates, const EnvironmentModel& error, LearntEnvironment& learnt);

}  // namespace reachlab::subjects
