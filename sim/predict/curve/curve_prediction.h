#pragma once
#include <memory>

#include "constraints/geometry/arc_curve.h"
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

}  // namespace reachlab::predict
