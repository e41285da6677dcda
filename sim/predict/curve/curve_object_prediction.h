#pragma once
#include <memory>

#include "constraints/geometry/arc_curve.h"
#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Least hand jerk (as makeCurveJerkProblem) that takes a chain or parallel object along a curve from rest to rest. Masses and hand are at
/// s = 0 at the beginning and at s = length() at T. The hand's arc length is [s(1-s)]^3 times polynomials. The masses follow by CurveMotion
/// and must arrive (2N conditions). Method: sequential quadratic programming with exact second derivatives of cost and conditions (Nocedal
/// and Wright, Numerical Optimization, ch. 18). Unknowns and intervals are raised until the profile is known to 1e-8 of its peak. The
/// masses must also arrive when followed on intervals four times as fine. On a straight line it is the linear prediction. Throws
/// RefusedError, with the numbers, when no minimum is found or the object would leave the known part of the curve.
std::unique_ptr<Prediction> makeCurveObjectPrediction(const constraints::ArcCurve& curve, const LineObject& object, double duration,
                                                      int unknowns);

}  // namespace reachlab::predict
