#pragma once
#include <vector>

#include "base/math/matrix.h"
#include "sim/predict/curve/curve_object.h"
#include "sim/predict/numerics/piecewise_series.h"

namespace reachlab::predict {

/// The masses as they follow a hand along the curve. Gauss collocation with eight stages on equal intervals of [0, T] has order 16 at their
/// ends. The derivatives of the computed result are exact, so that an optimisation may treat it as the equations themselves. All masses
/// rest at s = 0 at t = 0. Borrows curve and object. One thread.
class CurveMotion {
 public:
  static constexpr int kStages = 8;

  CurveMotion(const constraints::ArcCurve& curve, const LineObject& object, double duration, int intervals);

  int nodes() const { return intervals_ * kStages; }
  double timeOf(int node) const;
  /// Solves for the masses, given the hand's arc length and speed at all nodes. False when Newton's method does not settle in an interval.
  /// The motion must not be used in that case.
  bool follow(const Eigen::VectorXd& handPosition, const Eigen::VectorXd& handSpeed);
  /// Arc lengths, then speeds of all masses at T.
  const Eigen::VectorXd& end() const { return end_; }
  double lowest() const { return lowest_; }  // [m] any mass at any node
  double highest() const { return highest_; }

  /// Derivatives of end() (2N x columns) when the hand changes by these columns at all nodes. After follow().
  Eigen::MatrixXd linearise(const Eigen::MatrixXd& handPosition, const Eigen::MatrixXd& handSpeed);
  /// Second derivatives of multiplier . end() by the columns of the last linearise().
  Eigen::MatrixXd computeHessian(const Eigen::VectorXd& multiplier) const;

  /// All masses as power series over the intervals.
  PiecewiseSeries makeProfile() const;

 private:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  struct Interval {
    Vector position, speed;        // N, at its beginning
    Vector acceleration;           // N a stage, stage by stage
    std::vector<Matrix> jacobian;  // of the accelerations at every stage, see expandAccelerations
    Eigen::PartialPivLU<Matrix> factor;
  };
  void locateStage(const Interval& interval, int first, int stage, Vector& s, Vector& v) const;
  bool solveInterval(Interval& interval, int first);
  Matrix stageSystem(const Interval& interval) const;

  const constraints::ArcCurve& curve_;
  const LineObject& object_;
  int intervals_, n_;
  double width_;  // [s] of a interval
  Vector handPosition_, handSpeed_;
  std::vector<Interval> interval_;
  Vector end_;
  double lowest_ = 0, highest_ = 0;
  Matrix local_;  // 2(N+1) rows a node: changes of s and v of hand and masses, of each column
};

}  // namespace reachlab::predict
