#pragma once
#include <vector>

#include "base/math/matrix.h"
#include "constraints/geometry/arc_curve.h"
#include "sim/predict/line/line_object.h"

namespace reachlab::predict {

/// Chain or parallel object on a curve. Node 0 is the hand, and nodes 1 … N are the masses, at arc lengths s [m] with speeds v [m/s].
/// Springs and dampers act along the chords in space and are projected on the tangent. See docs/theory/motion.md, "Chains", for Eq. (11) in
/// arc length:
/// m_i s_i'' = T_i . sum_j (k (r_j - r_i) + b (T_j v_j - T_i v_i)) - viscosity_i v_i.
struct CurveObject {
  struct Link {
    int inner = 0, outer = 0;  // nodes; the inner one may be the hand
    double stiffness = 0;      // [N/m]
    double damping = 0;        // [N s/m]
  };
  std::vector<double> masses;  // [kg]
  std::vector<Link> links;
  std::vector<double> viscosity;  // [N s/m] on each mass

  int count() const { return static_cast<int>(masses.size()); }
  /// [rad/s] an upper bound of its frequencies and decay rates.
  double boundRate() const;
};
CurveObject makeCurveObject(const LineObject& object);

/// Accelerations a (N) at one instant. `jacobian` (N x 2(N+1), by s_0 … s_N, v_0 … v_N) receives their first derivatives. `hessian` (2(N+1)
/// square) has the second derivatives of sum_i weight_i a_i added to it.
void expandAccelerations(const constraints::ArcCurve& curve, const CurveObject& object, const double* s, const double* v, double* a,
                         Eigen::MatrixXd* jacobian = nullptr, const double* weight = nullptr, Eigen::MatrixXd* hessian = nullptr);

}  // namespace reachlab::predict
