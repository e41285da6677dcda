#pragma once
#include <array>
#include <memory_resource>
#include <type_traits>
#include <vector>

#include "sim/predict/line/control_problem.h"
#include "sim/predict/line/sparse_rows.h"
#include "sim/predict/numerics/lane_matrix.h"

namespace reachlab::predict {

/// The limits that depend on the digits of the arithmetic.
template <class Real>
struct Precision;
template <>
struct Precision<double> {
  static constexpr int kShortTerms = 15;  // of the Taylor series of e^{A s}: 0.5^15 / 15! < 1e-16
  static constexpr double kMaxCondition = 1e3, kNeedsNoCorrection = 0, kCorrected = 1e-12;
};
template <>
struct Precision<DoubleDouble> {
  static constexpr int kShortTerms = 25;  // < 1e-32
  // Condition below which no correction is made, and the part of the control below which a correction ends.
  static constexpr double kNeedsNoCorrection = 1e5, kCorrected = 1e-15;
};

template <class Real>
Real rounded(const DoubleDouble& x) {
  if constexpr (std::is_same_v<Real, double>) return x.hi;
  else return x;
}

/// s A without its zeros, and s b.
template <class Real>
struct ScaledSystem {
  using Batch = BatchOf<Real>;
  ScaledSystem(std::pmr::memory_resource* memory, const ControlProblem& system, const SparseRows& rows, const Real& s)
      : a(rows), entry(memory), drive(memory) {
    entry.reserve(rows.value.size());
    for (const DoubleDouble& value : rows.value) entry.push_back(rounded<Real>(value) * s);
    drive.reserve(system.b.size());
    for (const DoubleDouble& value : system.b) drive.push_back(rounded<Real>(value) * s);
  }
  // Row i of it, times kCount batches of x, whose rows are `stride` apart.
  template <int kCount>
  std::array<Batch, kCount> multiplyRow(int i, const Batch* x, int stride) const {
    std::array<Batch, kCount> sum{};
    for (int p = a.begin[i]; p < a.begin[i + 1]; ++p)
      for (int b = 0; b < kCount; ++b) addProduct(sum[b], entry[p], x[a.column[p] * stride + b]);
    return sum;
  }
  // to = factor (s A x + s b u), kCount batches side by side in each row.
  template <int kCount>
  void advance(const Batch* x, const std::array<Batch, kCount>& u, const Real& factor, Batch* to) const {
    for (size_t i = 0; i < drive.size(); ++i) {
      std::array<Batch, kCount> sum = multiplyRow<kCount>(static_cast<int>(i), x, kCount), scaled{};
      for (int b = 0; b < kCount; ++b) {
        addProduct(sum[b], drive[i], u[b]);
        settle(sum[b]);
        addProduct(scaled[b], factor, sum[b]);
        settle(scaled[b]);
        to[i * kCount + b] = scaled[b];
      }
    }
  }
  // to = start + factor s A m. `start` may be null. `to` differs from both operands.
  void multiply(const LaneMatrix<Real>& m, const Real& factor, const LaneMatrix<Real>* start, LaneMatrix<Real>& to) const {
    int first = 0;
    for (; first + 2 <= m.batches(); first += 2) multiplyPart<2>(m, first, factor, start, to);
    if (first < m.batches()) multiplyPart<1>(m, first, factor, start, to);
  }
  template <int kCount>
  void multiplyPart(const LaneMatrix<Real>& m, int first, const Real& factor, const LaneMatrix<Real>* start, LaneMatrix<Real>& to) const {
    for (int i = 0; i < m.rows(); ++i) {
      std::array<Batch, kCount> sum = multiplyRow<kCount>(i, m.row(0) + first, m.batches());
      for (int b = 0; b < kCount; ++b) {
        Batch result = start != nullptr ? start->row(i)[first + b] : Batch{};
        settle(sum[b]);
        addProduct(result, factor, sum[b]);
        settle(result);
        to.row(i)[first + b] = result;
      }
    }
  }

  const SparseRows& a;
  std::pmr::vector<Real> entry, drive;
};

/// 1, 1, 1/2, 1/3 …: the factor of the k-th term of a Taylor series over the preceding term.
template <class Real>
std::pmr::vector<Real> makeInverses(std::pmr::memory_resource* memory, int count) {
  std::pmr::vector<Real> inverse(static_cast<size_t>(count), Real(1.0), memory);
  for (int k = 2; k < count; ++k) inverse[k] = Real(1.0) / Real(1.0 * k);
  return inverse;
}

/// (sign s A)^k b / k!, one per row: the Taylor series of e^{sign A t} b in t / s.
template <class Real>
LaneMatrix<Real> makeImpulse(const ScaledSystem<Real>& system, const ControlProblem& problem, const Real& sign,
                             const std::pmr::vector<Real>& inverse, int terms, std::pmr::memory_resource* memory) {
  LaneMatrix<Real> impulse(memory, terms, problem.size), term(memory, problem.size, 1), next(memory, problem.size, 1);
  for (int i = 0; i < problem.size; ++i) term.set(i, 0, rounded<Real>(problem.b[i]));
  for (int k = 0; k < terms; ++k) {
    for (int i = 0; i < problem.size; ++i) impulse.set(k, i, term.at(i, 0));
    system.multiply(term, sign * inverse[k + 1], nullptr, next);
    std::swap(term, next);
  }
  return impulse;
}

}  // namespace reachlab::predict
