#pragma once
#include <Eigen/Dense>
#include <vector>

#include "sim/predict/curve_object.h"
#include "sim/predict/series_profile.h"

namespace reachlab::predict {

/// How the masses follow a hand along the curve: Gauss collocation with eight stages on equal panels of [0, T] (order 16 at their
/// ends), with the exact derivatives of its own result, so that an optimisation may take it for the equations themselves. All
/// masses rest at s = 0 at t = 0. Borrows curve and object. One thread.
class CurveMotion {
 public:
  static constexpr int kStages = 8;

  CurveMotion(const ArcCurve& curve, const CurveObject& object, double duration, int panels);

  int nodes() const { return panels_ * kStages; }
  double timeOf(int node) const;
  /// Solves for the masses, given the hand's arc length and speed at all nodes. False when Newton's method does not settle in a
  /// panel; the motion is then not to be used.
  bool follow(const Eigen::VectorXd& handPosition, const Eigen::VectorXd& handSpeed);
  /// Arc lengths, then speeds of all masses at T.
  const Eigen::VectorXd& end() const { return end_; }
  double lowest() const { return lowest_; }  // [m] any mass at any node
  double highest() const { return highest_; }

  /// Derivatives of end() (2N x columns) when the hand changes by these columns at all nodes. After follow().
  Eigen::MatrixXd linearise(const Eigen::MatrixXd& handPosition, const Eigen::MatrixXd& handSpeed);
  /// Second derivatives of multiplier . end() by the columns of the last linearise().
  Eigen::MatrixXd computeBend(const Eigen::VectorXd& multiplier) const;

  /// All masses as power series over the panels.
  SeriesProfile makeProfile() const;

 private:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  struct Panel {
    Vector position, speed;     // N, at its beginning
    Vector acceleration;        // N a stage, stage by stage
    std::vector<Matrix> slope;  // of the accelerations at every stage, see expandAccelerations
    Eigen::PartialPivLU<Matrix> factor;
  };
  void locateStage(const Panel& panel, int first, int stage, Vector& s, Vector& v) const;
  bool solvePanel(Panel& panel, int first);
  Matrix stageSystem(const Panel& panel) const;

  const ArcCurve& curve_;
  const CurveObject& object_;
  int panels_, n_;
  double width_;  // [s] of a panel
  Vector handPosition_, handSpeed_;
  std::vector<Panel> panel_;
  Vector end_;
  double lowest_ = 0, highest_ = 0;
  Matrix local_;  // 2(N+1) rows a node: changes of s and v of hand and masses, of each column
};

}  // namespace reachlab::predict
