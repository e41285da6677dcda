#pragma once
#include <Eigen/Core>

#include "sim/predict/panel_series.h"

namespace reachlab::predict {

/// W = int y y^T ds over the movement as Q^-T R^T R Q^-1, never formed: y is sampled on the Gauss nodes of all panels, its columns
/// turned about the object's modes, so that each can be scaled by itself, and reduced to a triangle by Householder reflections.
class PanelFactor {
 public:
  PanelFactor(const LineSystem<double>& system, const PanelGrid& grid, const PanelSeries<double>& series);

  /// Of R with columns of unit length; infinity when it is singular.
  double condition() const { return condition_; }
  struct Solution {
    Eigen::VectorXd l;  // W^-1 x
    double size = 0;    // |R^-T Q^T x|: root of the integral of (y^T l)^2
  };
  Solution solve(const Eigen::VectorXd& x) const;

 private:
  Eigen::MatrixXd turn_, factor_;  // Q, R
  double condition_ = 0;
};

/// Panels may be as wide as |A| times this [half a width] for the sixteen nodes to integrate y y^T to rounding.
inline constexpr double kPanelRate = 4;

}  // namespace reachlab::predict
