#pragma once
#include <memory>

#include "constraints/constraint.h"
#include "sim/predict/predict.h"

namespace reachlab {

/// Least squared jerk of a hand that moves its mass along a fixed curve from start to target (constraint parameters):
/// |r'''|^2 = (s''' - k^2 s'^3)^2 + (3 k s' s'' + k' s'^3)^2 + (k t s'^3)^2 with curvature k and torsion t (criteria.md 7), computed as
/// r''' = r_fff f'^3 + 3 r_ff f' f'' + r_f f''' in the curve's own parameter f = phi. Rest: r', r'' zero at both ends.
/// Hand and masses are one; positions are metres of arc length. Throws RefusedError at a cusp on the way.
std::unique_ptr<Prediction> makeCurveJerkPrediction(const Constraint& curve, double start, double target, double duration, int massCount, int unknowns);

/// The same on a surface, where the way from start to target is free too: u(t) and v(t) are both unknown.
std::unique_ptr<Prediction> makeSurfaceJerkPrediction(const Constraint& surface, const std::vector<double>& start, const std::vector<double>& target,
                                                      double duration, int massCount, int unknowns);

}  // namespace reachlab
