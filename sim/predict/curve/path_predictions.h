#pragma once
#include <memory>

#include "constraints/constraint_spec.h"
#include "constraints/geometry/arc_curve.h"
#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"
#include "sim/predict/transcription/transcribed_cost.h"

namespace reachlab::predict {

/// Squared jerk of a hand on a fixed curve, with s(t) of `curve` as the unknown motion: r''' = r_sss s'^3 + 3 r_ss s' s'' + r_s s'''. In
/// arc length, with curvature k and torsion t, |r'''|^2 = (s''' - k^2 s'^3)^2 + (3 k s' s'' + k' s'^3)^2 + (k t s'^3)^2. See
/// docs/theory/criteria.md, "Curves and surfaces". Rest at both ends with s'' = 0. Borrows the curve.
TranscribedProblem makeCurveJerkProblem(const constraints::ArcCurve& curve, double duration);

/// The least jerk for a hand that moves a single mass with it, from start to target (constraint parameters). It is computed in the curve's
/// own parameter, which passes near a cusp with fewer unknowns than the arc length. Positions are metres of arc length. Throws RefusedError
/// if a cusp lies between start and target.
std::unique_ptr<Prediction> makeCurveJerkPrediction(const constraints::Constraint& constraint, double start, double target, double duration,
                                                    int unknowns);

/// Least hand jerk (as makeCurveJerkProblem) that takes a chain or parallel object along a curve from rest to rest. Masses and hand are at
/// s = 0 at the beginning and at s = length() at T. The hand's arc length is [s(1-s)]^3 times polynomials. The masses follow by CurveMotion
/// and must arrive (2N conditions). Method: sequential quadratic programming with exact second derivatives of cost and conditions (Nocedal
/// and Wright, Numerical Optimization, ch. 18). Unknowns and intervals are raised until the profile is known to 1e-8 of its peak. The
/// masses must also arrive when followed on intervals four times as fine. On a straight line it is the linear prediction. Throws
/// RefusedError, with the numbers, when no minimum is found or the object would leave the known part of the curve.
std::unique_ptr<Prediction> makeCurveObjectPrediction(const constraints::ArcCurve& curve, const LineObject& object, double duration,
                                                      int unknowns);

/// Least squared jerk |r'''|^2 of a hand that moves its mass on a surface from start to target (constraint parameters). The path between
/// them is free: u(t) and v(t) are both unknown. Rest: r', r'' zero at both ends. Hand and mass move together. Positions are metres of arc
/// length.
std::unique_ptr<Prediction> makeSurfaceJerkPrediction(const constraints::Constraint& surface, const std::vector<double>& start,
                                                      const std::vector<double>& target, double duration, int massCount, int unknowns);

}  // namespace reachlab::predict
