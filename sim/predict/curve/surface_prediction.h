#pragma once
#include <memory>

#include "constraints/constraint_spec.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Least squared jerk |r'''|^2 of a hand that moves its mass on a surface from start to target (constraint parameters). The path between
/// them is free: u(t) and v(t) are both unknown. Rest: r', r'' zero at both ends. Hand and mass move together. Positions are metres of arc
/// length.
std::unique_ptr<Prediction> makeSurfaceJerkPrediction(const constraints::Constraint& surface, const std::vector<double>& start,
                                                      const std::vector<double>& target, double duration, int massCount, int unknowns);

}  // namespace reachlab::predict
