#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/predict/line_system.h"

namespace reachlab::predict {

/// A of the first `rows` states (or its transpose) without its zeros, row by row. Real is double or DoubleDouble.
template <class Real>
struct SparseRows {
  SparseRows(std::vector<int> begins, std::vector<int> columns, std::vector<Real> values)
      : begin(std::move(begins)), column(std::move(columns)), value(std::move(values)) {}
  SparseRows(const LineSystem<Real>& system, int rows, bool transposed) : begin(1, 0) {
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < rows; ++j) {
        const Real& entry =
            transposed ? system.a[static_cast<size_t>(j) * system.size + i] : system.a[static_cast<size_t>(i) * system.size + j];
        if (static_cast<double>(entry) == 0) continue;
        column.push_back(j);
        value.push_back(entry);
      }
      begin.push_back(static_cast<int>(value.size()));
    }
  }

  void scale(const Real& factor) {
    for (Real& entry : value) entry *= factor;
  }

  /// y = factor A x.
  void multiply(const std::vector<Real>& x, Real factor, std::vector<Real>& y) const {
    for (size_t i = 0; i + 1 < begin.size(); ++i) {
      Real sum = 0.0;
      for (int p = begin[i]; p < begin[i + 1]; ++p) sum += value[p] * x[column[p]];
      y[i] = factor * sum;
    }
  }

  /// Square root of the product of row and column sums, an upper bound of the spectral norm.
  double norm() const {
    std::vector<double> columns(begin.size(), 0.0);
    double most = 0;
    for (size_t i = 0; i + 1 < begin.size(); ++i) {
      double row = 0;
      for (int p = begin[i]; p < begin[i + 1]; ++p) {
        const double size = std::abs(static_cast<double>(value[p]));
        row += size;
        columns[column[p]] += size;
      }
      most = std::max(most, row);
    }
    return std::sqrt(most * *std::max_element(columns.begin(), columns.end()));
  }

  std::vector<int> begin, column;  // entries begin[i] … begin[i+1]-1 are row i's
  std::vector<Real> value;
};

}  // namespace reachlab::predict
