#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/matrix.h"
#include "sim/predict/numerics/wide_lanes.h"

namespace reachlab::predict {

/// A dense matrix of doubles or DoubleDoubles, row by row, each row in whole batches of lanes (what is beyond the last column is zero).
template <class Real>
class LaneMatrix {
 public:
  using Batch = BatchOf<Real>;
  LaneMatrix(int rows, int columns)
      : rows_(rows), columns_(columns), batches_(lanesFor<kBatchLanes>(columns)), value_(static_cast<size_t>(rows_) * batches_) {}
  static LaneMatrix identity(int size) {
    LaneMatrix made(size, size);
    for (int i = 0; i < size; ++i) made.set(i, i, 1.0);
    return made;
  }
  explicit LaneMatrix(const Eigen::MatrixXd& from) : LaneMatrix(static_cast<int>(from.rows()), static_cast<int>(from.cols())) {
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < columns_; ++j) set(i, j, from(i, j));
  }

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int batches() const { return batches_; }
  Batch* row(int i) { return &value_[static_cast<size_t>(i) * batches_]; }
  const Batch* row(int i) const { return &value_[static_cast<size_t>(i) * batches_]; }
  Real at(int i, int j) const { return laneOf(row(i)[j / kBatchLanes], j % kBatchLanes); }
  void set(int i, int j, const Real& value) { setLane(row(i)[j / kBatchLanes], j % kBatchLanes, value); }

 private:
  int rows_, columns_, batches_;
  std::vector<Batch> value_;
};

/// kCount batches of to = start + row * m, one row each, from the batch `first` on: independent sums do not wait for each other.
template <int kCount, class Real>
void multiplyRowPart(const BatchOf<Real>* row, const LaneMatrix<Real>& m, int first, const BatchOf<Real>* start, BatchOf<Real>* to) {
  std::array<BatchOf<Real>, kCount> sum{};
  if (start != nullptr)
    for (int b = 0; b < kCount; ++b) sum[b] = start[first + b];
  for (int k = 0; k < m.rows(); ++k) {
    const Real factor = laneOf(row[k / kBatchLanes], k % kBatchLanes);
    if (leading(factor) == 0) continue;
    const BatchOf<Real>* other = m.row(k) + first;
    for (int b = 0; b < kCount; ++b) addProduct(sum[b], factor, other[b]);
  }
  for (int b = 0; b < kCount; ++b) {
    settle(sum[b]);
    to[first + b] = sum[b];
  }
}

/// to = start + row * m, one row each; `start` may be null; `to` is neither of the others.
template <class Real>
void multiplyRow(const BatchOf<Real>* row, const LaneMatrix<Real>& m, const BatchOf<Real>* start, BatchOf<Real>* to) {
  int first = 0;
  for (; first + 4 <= m.batches(); first += 4) multiplyRowPart<4>(row, m, first, start, to);
  switch (m.batches() - first) {
    case 3: return multiplyRowPart<3>(row, m, first, start, to);
    case 2: return multiplyRowPart<2>(row, m, first, start, to);
    case 1: return multiplyRowPart<1>(row, m, first, start, to);
    default: return;
  }
}

/// to = a b; `to` has the product's size and is neither factor.
template <class Real>
void multiply(const LaneMatrix<Real>& a, const LaneMatrix<Real>& b, LaneMatrix<Real>& to) {
  for (int i = 0; i < a.rows(); ++i) multiplyRow(a.row(i), b, nullptr, to.row(i));
}

template <class Real>
LaneMatrix<Real> operator*(const LaneMatrix<Real>& a, const LaneMatrix<Real>& b) {
  LaneMatrix<Real> product(a.rows(), b.columns());
  multiply(a, b, product);
  return product;
}

template <class Real>
LaneMatrix<Real>& operator+=(LaneMatrix<Real>& to, const LaneMatrix<Real>& more) {
  for (int i = 0; i < to.rows(); ++i)
    for (int b = 0; b < to.batches(); ++b) {
      addProduct(to.row(i)[b], Real(1.0), more.row(i)[b]);
      settle(to.row(i)[b]);
    }
  return to;
}

/// to = a transposed; `to` has its size and is not a.
template <class Real>
void transpose(const LaneMatrix<Real>& a, LaneMatrix<Real>& to) {
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) to.set(j, i, a.at(i, j));
}

template <class Real>
LaneMatrix<Real> transpose(const LaneMatrix<Real>& a) {
  LaneMatrix<Real> turned(a.columns(), a.rows());
  transpose(a, turned);
  return turned;
}

/// The lower triangle L with L L^T = a symmetric matrix; rows of NaN where it is not positive definite to its digits.
template <class Real>
std::vector<std::vector<Real>> factoriseCholesky(const LaneMatrix<Real>& a) {
  using std::sqrt;
  const auto n = static_cast<size_t>(a.rows());
  std::vector<std::vector<Real>> l(n);
  std::vector<Real> inverse(n);  // of the diagonal
  for (size_t i = 0; i < n; ++i) {
    l[i].resize(i + 1);
    for (size_t j = 0; j <= i; ++j) {
      Real sum = a.at(static_cast<int>(i), static_cast<int>(j));
      for (size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (j < i) {
        l[i][j] = sum * inverse[j];
      } else {
        l[i][i] = leading(sum) > 0 ? sqrt(sum) : Real(std::numeric_limits<double>::quiet_NaN());
        inverse[i] = Real(1.0) / l[i][i];
      }
    }
  }
  return l;
}

}  // namespace reachlab::predict
