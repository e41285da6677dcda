#pragma once
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sim/predict/line/scaled_system.h"
#include "sim/predict/numerics/piecewise_series.h"

namespace reachlab::predict {

inline constexpr double kSeriesRounding = 1e-17;  // what is left out of the profile's Taylor series

/// Terms of the Taylor series of e^{rate s}, 0 <= s <= 1, up to `rounding` of the largest.
inline int countTerms(double rate, double rounding) {
  double size = 1, largest = 1;
  int k = 0;
  while (size > rounding * largest || k < rate) {
    size *= rate / ++k;
    largest = std::max(largest, size);
  }
  return k + 1;
}

/// The movement in equal time intervals, each by Taylor series about its middle, in the digits of Real. Eight intervals are a batch.
template <class Real>
class EnergyMovement {
 public:
  using Batch = BatchOf<Real>;
  EnergyMovement(const ControlProblem& system, const SparseRows& a, int intervals, double halfWidth, LaneMatrix<Real> half,
                 const LaneMatrix<Real>& whole, double condition)
      : size_(system.size), count_(intervals), terms_(countTerms(a.norm() * halfWidth, kSeriesRounding / condition)),
        memory_(half.memory()), scaled_(memory_, system, a, halfWidth), inverse_(makeInverses<Real>(memory_, terms_ + 1)),
        half_(std::move(half)), halfTurned_(transpose(half_)), whole_(whole),
        gain_(makeImpulse<Real>(scaled_, system, -1.0, inverse_, terms_, memory_)), adjoint_(memory_, count_, size_),
        atBegin_(memory_, count_, size_), atEnd_(memory_, count_, size_), row_(memory_, 2, size_), lane_(memory_, 5 * 2 * size_, 1),
        control_(memory_, lanesFor<kBatchLanes>(count_) * terms_, kBatchLanes), state(memory_, count_, size_) {}

  // The control is u = b^T adjoint, with the adjoint backwards from `weights` at T. The states follow it from rest. Returns the end state.
  std::vector<Real> follow(const std::vector<Real>& weights) {
    const int n = size_;
    for (int i = 0; i < n; ++i) row_.set(0, i, weights[i]);
    multiplyRow(row_.row(0), half_, nullptr, adjoint_.row(count_ - 1));
    for (int p = count_ - 1; p > 0; --p) multiplyRow(adjoint_.row(p), whole_, nullptr, adjoint_.row(p - 1));
    int first = 0;
    for (; first + kBatchLanes < count_; first += 2 * kBatchLanes) respond<2>(first);
    if (first < count_) respond<1>(first);
    for (int i = 0; i < n; ++i) row_.set(1, i, 0.0);
    for (int p = 0; p < count_; ++p) {  // x(begin) = e^{-A half} x(middle) + what the control adds from there on
      for (int i = 0; i < n; ++i) row_.set(0, i, row_.at(1, i) - atBegin_.at(p, i));
      multiplyRow(row_.row(0), halfTurned_, nullptr, state.row(p));
      multiplyRow(state.row(p), halfTurned_, atEnd_.row(p), row_.row(1));
    }
    std::vector<Real> end;
    end.reserve(static_cast<size_t>(n));
    for (int i = 0; i < n; ++i) end.push_back(row_.at(1, i));
    return end;
  }

  // The k-th Taylor coefficient, over half an interval, of the control in the batch that begins with the interval `first`.
  const Batch& control(int first, int k) const { return control_.row(first / kBatchLanes * terms_ + k)[0]; }

 private:
  // The control of kCount batches, beginning with the interval `first`. Also the states under it, from zero in the middle of each interval
  // to both of its ends.
  template <int kCount>
  void respond(int first) {
    const int n = size_, part = n * kCount;
    Batch *x = lane_.row(0), *next = x + part;
    Batch *const begin = next + part, *const end = begin + part, *const adjoint = end + part;
    std::fill(x, adjoint + part, Batch{});
    const auto forEach = [&](const auto& visit) {
      for (int b = 0; b < kCount; ++b)
        for (int lane = 0; lane < kBatchLanes && first + b * kBatchLanes + lane < count_; ++lane)
          for (int i = 0; i < n; ++i) visit(i * kCount + b, lane, first + b * kBatchLanes + lane, i);
    };
    forEach([&](int place, int lane, int interval, int i) { setLane(adjoint[place], lane, adjoint_.at(interval, i)); });
    const Real plus = 1.0, minus = -1.0;
    for (int k = 0; k < terms_; ++k) {
      std::array<Batch, kCount> u{};
      for (int i = 0; i < n; ++i)
        for (int b = 0; b < kCount; ++b) addProduct(u[b], gain_.at(k, i), adjoint[i * kCount + b]);
      for (int b = 0; b < kCount; ++b) {
        settle(u[b]);
        control_.row((first / kBatchLanes + b) * terms_ + k)[0] = u[b];
      }
      if (k + 1 == terms_) break;
      scaled_.template advance<kCount>(x, u, inverse_[k + 1], next);
      for (int i = 0; i < part; ++i) {
        addProduct(end[i], plus, next[i]);
        addProduct(begin[i], k % 2 ? plus : minus, next[i]);
      }
      std::swap(x, next);
    }
    for (int i = 0; i < part; ++i) settle(begin[i]), settle(end[i]);
    forEach([&](int place, int lane, int interval, int i) {
      atBegin_.set(interval, i, laneOf(begin[place], lane));
      atEnd_.set(interval, i, laneOf(end[place], lane));
    });
  }

  int size_, count_, terms_;
  std::pmr::memory_resource* memory_;
  ScaledSystem<Real> scaled_;
  std::pmr::vector<Real> inverse_;
  LaneMatrix<Real> half_, halfTurned_;
  const LaneMatrix<Real>& whole_;
  LaneMatrix<Real> gain_;                             // of the adjoint in the control's terms: (-half A)^k b / k!, in rows
  LaneMatrix<Real> adjoint_, atBegin_, atEnd_, row_;  // in the middles, and what the control adds up to both ends, in rows
  LaneMatrix<Real> lane_, control_;

 public:
  LaneMatrix<Real> state;  // in the middles, in rows
};

/// Each output by its few differences from the one before: neighbours in a chain share most of their row.
struct Difference {
  int output, state;  // state n is the control
  double factor;
};
inline std::vector<Difference> makeDifferences(const ControlProblem& system) {
  std::vector<Difference> differences;
  for (size_t o = 0; o < system.output.size(); ++o)
    for (int i = 0; i <= system.size; ++i) {
      const double factor = system.output[o][i].hi - (o > 0 ? system.output[o - 1][i].hi : 0.0);
      if (factor != 0) differences.push_back({static_cast<int>(o), i, factor});
    }
  return differences;
}

/// Taylor series of the states and outputs in double, kCount batches of intervals side by side, from the interval `first` on.
template <int kCount, class Real>
void fillProfile(const ScaledSystem<double>& scaled, const std::vector<Difference>& differences, const std::pmr::vector<double>& inverse,
                 const EnergyMovement<Real>& movement, int first, LaneMatrix<double>& lanes, PiecewiseSeries& profile) {
  const int n = static_cast<int>(scaled.drive.size());
  LaneBatch *x = lanes.row(0), *next = x + n * kCount;
  for (int i = 0; i < n; ++i)
    for (int b = 0; b < kCount; ++b)
      for (int lane = 0; lane < kBatchLanes; ++lane) {
        const int interval = first + b * kBatchLanes + lane;
        x[i * kCount + b][lane] = interval < profile.intervals ? leading(movement.state.at(interval, i)) : 0.0;
      }
  double unit = 1;  // the profile counts in whole intervals
  for (int k = 0; k < profile.terms; ++k, unit *= 2) {
    std::array<LaneBatch, kCount> u, position{};
    for (int b = 0; b < kCount; ++b) u[b] = leading(movement.control(first + b * kBatchLanes, k));
    auto difference = differences.begin();
    for (int o = 0; o < profile.outputs; ++o) {
      for (; difference != differences.end() && difference->output == o; ++difference)
        for (int b = 0; b < kCount; ++b)
          position[b] += difference->factor * (difference->state < n ? x[difference->state * kCount + b] : u[b]);
      for (int b = 0; b < kCount; ++b) profile.of(first + b * kBatchLanes, o)[k] = unit * position[b];
    }
    scaled.advance<kCount>(x, u, inverse[k + 1], next);
    std::swap(x, next);
  }
}

template <class Real>
PiecewiseSeries makeProfile(const ControlProblem& system, const SparseRows& a, const EnergyMovement<Real>& movement, int intervals,
                            double halfWidth, std::pmr::memory_resource* memory) {
  PiecewiseSeries profile(static_cast<int>(system.output.size()), countTerms(a.norm() * halfWidth, kSeriesRounding), intervals);
  profile.width = 2 * halfWidth;
  profile.centre = 0.5;
  const std::vector<Difference> differences = makeDifferences(system);
  const ScaledSystem<double> scaled(memory, system, a, halfWidth);
  const std::pmr::vector<double> inverse = makeInverses<double>(memory, profile.terms + 1);
  LaneMatrix<double> lanes(memory, 2 * 2 * system.size, 1);
  int first = 0;
  for (; first + kBatchLanes < intervals; first += 2 * kBatchLanes)
    fillProfile<2>(scaled, differences, inverse, movement, first, lanes, profile);
  if (first < intervals) fillProfile<1>(scaled, differences, inverse, movement, first, lanes, profile);
  return profile;
}

}  // namespace reachlab::predict
