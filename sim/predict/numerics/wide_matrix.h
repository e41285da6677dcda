#pragma once
#include <Eigen/Core>
#include <vector>

#include "sim/predict/numerics/wide_lanes.h"

namespace reachlab::predict {

/// A dense matrix of DoubleDoubles, row by row, each row in whole batches of lanes (what is beyond the last column is zero).
class WideMatrix {
 public:
  WideMatrix(int rows, int columns)
      : rows_(rows), columns_(columns), batches_((columns + kLanes - 1) / kLanes), value_(static_cast<size_t>(rows_) * batches_) {}
  static WideMatrix identity(int size);
  explicit WideMatrix(const Eigen::MatrixXd& from);

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int batches() const { return batches_; }
  WideBatch* row(int i) { return &value_[static_cast<size_t>(i) * batches_]; }
  const WideBatch* row(int i) const { return &value_[static_cast<size_t>(i) * batches_]; }
  DoubleDouble at(int i, int j) const { return laneOf(row(i)[j / kLanes], j % kLanes); }
  void set(int i, int j, const DoubleDouble& value) { setLane(row(i)[j / kLanes], j % kLanes, value); }

 private:
  int rows_, columns_, batches_;
  std::vector<WideBatch> value_;
};

WideMatrix operator*(const WideMatrix& a, const WideMatrix& b);
WideMatrix& operator+=(WideMatrix& to, const WideMatrix& more);
WideMatrix transpose(const WideMatrix& a);
/// to = start + row * m, one row each; `start` may be null.
void multiplyRow(const WideBatch* row, const WideMatrix& m, const WideBatch* start, WideBatch* to);

/// The lower triangle L with L L^T = a symmetric matrix; rows of NaN where it is not positive definite to 32 digits.
std::vector<std::vector<DoubleDouble>> factoriseCholesky(const WideMatrix& a);

}  // namespace reachlab::predict
