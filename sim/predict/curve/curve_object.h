#pragma once
#include "base/math/matrix.h"
#include "constraints/geometry/arc_curve.h"
#include "sim/predict/line/line_object.h"

namespace reachlab::predict {

/// Chain or parallel object on a curve. Node 0 is the hand, and nodes 1 … N are the masses, at arc lengths s [m] with speeds v [m/s].
/// Springs and dampers act along the chords in space and are projected on the tangent. See docs/theory/motion.md, "Chains", for Eq. (11) in
/// arc length:
/// m_i s_i'' = T_i . sum_j (k (r_j - r_i) + b (T_j v_j - T_i v_i)) - viscosity_i v_i.
/// Accelerations a (N) at one instant. `jacobian` (N x 2(N+1), by s_0 … s_N, v_0 … v_N) receives their first derivatives. `hessian` (2(N+1)
/// square) has the second derivatives of sum_i weight_i a_i added to it.
void expandAccelerations(const constraints::ArcCurve& curve, const LineObject& object, const double* s, const double* v, double* a,
                         Eigen::MatrixXd* jacobian = nullptr, const double* weight = nullptr, Eigen::MatrixXd* hessian = nullptr);

/// [rad/s] an upper bound of the object's frequencies and decay rates.
double boundRate(const LineObject& object);

}  // namespace reachlab::predict
