#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/predict/line/control_problem.h"

namespace reachlab::predict {

/// A without its zeros, row by row.
struct SparseRows {
  explicit SparseRows(const ControlProblem& system) : begin(1, 0) {
    const auto entries = std::count_if(system.a.begin(), system.a.end(), [](const DoubleDouble& entry) { return entry.hi != 0; });
    begin.reserve(static_cast<size_t>(system.size) + 1);
    column.reserve(static_cast<size_t>(entries));
    value.reserve(static_cast<size_t>(entries));
    for (int i = 0; i < system.size; ++i) {
      for (int j = 0; j < system.size; ++j) {
        const DoubleDouble& entry = system.a[static_cast<size_t>(i) * system.size + j];
        if (entry.hi == 0) continue;
        column.push_back(j);
        value.push_back(entry);
      }
      begin.push_back(static_cast<int>(value.size()));
    }
  }

  /// Square root of the product of row and column sums, an upper bound of the spectral norm.
  double norm() const {
    std::vector<double> columns(begin.size(), 0.0);
    double most = 0;
    for (size_t i = 0; i + 1 < begin.size(); ++i) {
      double row = 0;
      for (int p = begin[i]; p < begin[i + 1]; ++p) {
        const double size = std::abs(value[p].hi);
        row += size;
        columns[column[p]] += size;
      }
      most = std::max(most, row);
    }
    return std::sqrt(most * *std::max_element(columns.begin(), columns.end()));
  }

  std::vector<int> begin, column;  // entries begin[i] … begin[i+1]-1 are row i's
  std::vector<DoubleDouble> value;
};

}  // namespace reachlab::predict
