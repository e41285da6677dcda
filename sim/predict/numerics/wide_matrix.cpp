#include "sim/predict/numerics/wide_matrix.h"

#include <array>
#include <limits>

namespace reachlab::predict {

WideMatrix WideMatrix::identity(int size) {
  WideMatrix made(size, size);
  for (int i = 0; i < size; ++i) made.set(i, i, 1.0);
  return made;
}

WideMatrix::WideMatrix(const Eigen::MatrixXd& from) : WideMatrix(static_cast<int>(from.rows()), static_cast<int>(from.cols())) {
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j) set(i, j, from(i, j));
}

void multiplyRow(const WideBatch* row, const WideMatrix& m, const WideBatch* start, WideBatch* to) {
  constexpr int kAtOnce = 4;  // independent sums do not wait for each other
  for (int first = 0; first < m.batches(); first += kAtOnce) {
    const int count = std::min(kAtOnce, m.batches() - first);
    std::array<WideBatch, kAtOnce> sum{};
    for (int b = 0; b < count && start != nullptr; ++b) sum[b] = start[first + b];
    for (int k = 0; k < m.rows(); ++k) {
      const DoubleDouble factor = laneOf(row[k / kLanes], k % kLanes);
      if (factor.hi == 0) continue;
      const WideBatch* other = m.row(k) + first;
      for (int b = 0; b < count; ++b) addProduct(sum[b], factor, other[b]);
    }
    for (int b = 0; b < count; ++b) {
      settle(sum[b]);
      to[first + b] = sum[b];
    }
  }
}

WideMatrix operator*(const WideMatrix& a, const WideMatrix& b) {
  WideMatrix product(a.rows(), b.columns());
  for (int i = 0; i < a.rows(); ++i) multiplyRow(a.row(i), b, nullptr, product.row(i));
  return product;
}

WideMatrix& operator+=(WideMatrix& to, const WideMatrix& more) {
  const WideBatch one{LaneBatch{} + 1.0, LaneBatch{}};
  for (int i = 0; i < to.rows(); ++i)
    for (int b = 0; b < to.batches(); ++b) {
      addProduct(to.row(i)[b], one, more.row(i)[b]);
      settle(to.row(i)[b]);
    }
  return to;
}

WideMatrix transpose(const WideMatrix& a) {
  WideMatrix turned(a.columns(), a.rows());
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.columns(); ++j) turned.set(j, i, a.at(i, j));
  return turned;
}

std::vector<std::vector<DoubleDouble>> factoriseCholesky(const WideMatrix& a) {
  const auto n = static_cast<size_t>(a.rows());
  std::vector<std::vector<DoubleDouble>> l(n);
  std::vector<DoubleDouble> inverse(n);  // of the diagonal
  for (size_t i = 0; i < n; ++i) {
    l[i].resize(i + 1);
    for (size_t j = 0; j <= i; ++j) {
      DoubleDouble sum = a.at(static_cast<int>(i), static_cast<int>(j));
      for (size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (j < i) {
        l[i][j] = sum * inverse[j];
      } else {
        l[i][i] = sum.hi > 0 ? sqrt(sum) : DoubleDouble(std::numeric_limits<double>::quiet_NaN());
        inverse[i] = DoubleDouble(1.0) / l[i][i];
      }
    }
  }
  return l;
}

}  // namespace reachlab::predict
