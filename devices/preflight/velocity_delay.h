#pragma once
#include "sim/experiment/velocity_estimator_spec.h"

namespace reachlab::devices {

/// The delay [s] of the velocity estimate of a slow movement (VelocityEstimator), as its filters state it, with the half tick of a
/// difference. `auto` counts as butterworth, its value for a device that measures no velocity. The adaptive window counts with half of its
/// longest length. Any thread.
double velocityDelay(const experiment::VelocityEstimatorSpec& spec);

}  // namespace reachlab::devices
