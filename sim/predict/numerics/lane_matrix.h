#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <vector>

#include "base/math/matrix.h"
#include "sim/predict/numerics/wide_lanes.h"

namespace reachlab::predict {

/// A dense matrix of doubles or DoubleDoubles, row by row. Each row has whole batches of lanes, with zeros beyond the last column. Its
/// storage comes from `memory`, which outlives it and is the same for all matrices of one computation.
template <class Real>
class LaneMatrix {
 public:
  using Batch = BatchOf<Real>;
  LaneMatrix(std::pmr::memory_resource* memory, int rows, int columns)
      : rows_(rows), columns_(columns), batches_(lanesFor<kBatchLanes>(columns)),
        value_(static_cast<size_t>(rows_) * batches_, Batch{}, memory) {}
  LaneMatrix(std::pmr::memory_resource* memory, const Eigen::MatrixXd& from)
      : LaneMatrix(memory, static_cast<int>(from.rows()), static_cast<int>(from.cols())) {
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < columns_; ++j) set(i, j, from(i, j));
  }
  static LaneMatrix identity(std::pmr::memory_resource* memory, int size) {
    LaneMatrix made(memory, size, size);
    for (int i = 0; i < size; ++i) made.set(i, i, 1.0);
    return made;
  }
  LaneMatrix(LaneMatrix&&) = default;
  LaneMatrix& operator=(LaneMatrix&&) = default;
  LaneMatrix copy() const {
    LaneMatrix made(memory(), rows_, columns_);
    made.value_ = value_;
    return made;
  }

  std::pmr::memory_resource* memory() const { return value_.get_allocator().resource(); }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  int batches() const { return batches_; }
  Batch* row(int i) { return &value_[static_cast<size_t>(i) * batches_]; }
  const Batch* row(int i) const { return &value_[static_cast<size_t>(i) * batches_]; }
  Real at(int i, int j) const { return laneOf(row(i)[j / kBatchLanes], j % kBatchLanes); }
  void set(int i, int j, const Real& value) { setLane(row(i)[j / kBatchLanes], j % kBatchLanes, value); }

 private:
  int rows_, columns_, batches_;
  std::pmr::vector<Batch> value_;
};

/// kRows rows of to = a m from row i on, kCount batches of each from the batch `first` on. Independent sums do not wait for each other.
template <int kRows, int kCount, class Real>
void multiplyPart(const LaneMatrix<Real>& a, int i, const LaneMatrix<Real>& m, int first, LaneMatrix<Real>& to) {
  std::array<std::array<BatchOf<Real>, kCount>, kRows> sum{};
  for (int k = 0; k < m.rows(); ++k) {
    std::array<Real, kRows> factor;
    bool none = true;
    for (int r = 0; r < kRows; ++r) {
      factor[r] = a.at(i + r, k);
      none = none && leading(factor[r]) == 0;
    }
    if (none) continue;
    const BatchOf<Real>* other = m.row(k) + first;
    for (int r = 0; r < kRows; ++r)
      for (int b = 0; b < kCount; ++b) addProduct(sum[r][b], factor[r], other[b]);
  }
  for (int r = 0; r < kRows; ++r)
    for (int b = 0; b < kCount; ++b) {
      settle(sum[r][b]);
      to.row(i + r)[first + b] = sum[r][b];
    }
}

template <int kRows, class Real>
void multiplyRows(const LaneMatrix<Real>& a, int i, const LaneMatrix<Real>& m, LaneMatrix<Real>& to) {
  int first = 0;
  for (; first + 2 <= m.batches(); first += 2) multiplyPart<kRows, 2>(a, i, m, first, to);
  if (first < m.batches()) multiplyPart<kRows, 1>(a, i, m, first, to);
}

/// to = a m. `to` has the product's size and differs from both factors.
template <class Real>
void multiply(const LaneMatrix<Real>& a, const LaneMatrix<Real>& m, LaneMatrix<Real>& to) {
  int i = 0;
  for (; i + 4 <= a.rows(); i += 4) multiplyRows<4>(a, i, m, to);
  for (; i < a.rows(); ++i) multiplyRows<1>(a, i, m, to);
}

/// kCount batches of to = start + row m from the batch `first` on. Even and odd terms do not wait for each other.
template <int kCount, class Real>
void multiplyRowPart(const BatchOf<Real>* row, const LaneMatrix<Real>& m, int first, const BatchOf<Real>* start, BatchOf<Real>* to) {
  std::array<BatchOf<Real>, kCount> even{}, odd{};
  if (start != nullptr)
    for (int b = 0; b < kCount; ++b) even[b] = start[first + b];
  const auto add = [&](int k, std::array<BatchOf<Real>, kCount>& sum) {
    for (int b = 0; b < kCount; ++b) addProduct(sum[b], laneOf(row[k / kBatchLanes], k % kBatchLanes), m.row(k)[first + b]);
  };
  int k = 0;
  for (; k + 2 <= m.rows(); k += 2) add(k, even), add(k + 1, odd);
  if (k < m.rows()) add(k, even);
  for (int b = 0; b < kCount; ++b) {
    settle(even[b]), settle(odd[b]);
    addProduct(even[b], Real(1.0), odd[b]);
    settle(even[b]);
    to[first + b] = even[b];
  }
}

/// to = start + row m, one row each. `start` may be null. `to` differs from both operands.
template <class Real>
void multiplyRow(const BatchOf<Real>* row, const LaneMatrix<Real>& m, const BatchOf<Real>* start, BatchOf<Real>* to) {
  int first = 0;
  for (; first + 2 <= m.batches(); first += 2) multiplyRowPart<2>(row, m, first, start, to);
  if (first < m.batches()) multiplyRowPart<1>(row, m, first, start, to);
}

template <class Real>
LaneMatrix<Real> operator*(const LaneMatrix<Real>& a, const LaneMatrix<Real>& b) {
  LaneMatrix<Real> product(a.memory(), a.rows(), b.columns());
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

/// to = a transposed. `to` has its size and is not a.
template <class Real>
void transpose(const LaneMatrix<Real>& a, LaneMatrix<Real>& to) {
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) to.set(j, i, a.at(i, j));
}

template <class Real>
LaneMatrix<Real> transpose(const LaneMatrix<Real>& a) {
  LaneMatrix<Real> turned(a.memory(), a.columns(), a.rows());
  transpose(a, turned);
  return turned;
}

/// The lower triangle L with L L^T = a symmetric matrix, n numbers per row. Only the lower triangle of the matrix is read. The result is
/// NaN if the matrix is not positive definite to its digits.
template <class Real>
std::pmr::vector<Real> factoriseCholesky(const LaneMatrix<Real>& a) {
  using std::sqrt;
  const auto n = static_cast<size_t>(a.rows());
  std::pmr::vector<Real> l(n * n, a.memory()), inverse(n, a.memory());  // inverse of the diagonal
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j <= i; ++j) {
      Real* const row = &l[i * n];
      const Real* const other = &l[j * n];
      Real sum = a.at(static_cast<int>(i), static_cast<int>(j));
      for (size_t k = 0; k < j; ++k) sum -= row[k] * other[k];
      if (j < i) {
        row[j] = sum * inverse[j];
      } else {
        row[i] = leading(sum) > 0 ? sqrt(sum) : Real(std::numeric_limits<double>::quiet_NaN());
        inverse[i] = Real(1.0) / row[i];
      }
    }
  return l;
}

}  // namespace reachlab::predict
