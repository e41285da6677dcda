#include "sim/predict/line/minimum_energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <optional>
#include <type_traits>

#include "base/error.h"
#include "base/math/matrix.h"
#include "sim/predict/line/sparse_rows.h"
#include "sim/predict/numerics/lane_matrix.h"
#include "sim/predict/prediction/condition.h"

namespace reachlab::predict {
namespace {

constexpr double kShort = 0.5;       // fastest rate times the time that the doubling starts from
constexpr int kHalfDoublings = 3;    // from there to half an interval of the profile: rate times half an interval is 4 at most
constexpr double kRounding = 1e-17;  // what is left out of the profile's Taylor series

constexpr int kMaxPasses = 4;
constexpr size_t kFirstMemory = 48 * 1024;  // [B] of a chain of five in double

// What the digits of the arithmetic ask for.
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
  // Condition below which no correction is asked for, and the part of the control that is none.
  static constexpr double kNeedsNoCorrection = 1e5, kCorrected = 1e-15;
};

template <class Real>
Real rounded(const DoubleDouble& x) {
  if constexpr (std::is_same_v<Real, double>) return x.hi;
  else return x;
}

// s A without its zeros, and s b.
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
  // to = start + factor s A m; `start` may be null; `to` is neither of the others.
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

// 1, 1, 1/2, 1/3 …: what the k-th term of a Taylor series has beside the one before.
template <class Real>
std::pmr::vector<Real> makeInverses(std::pmr::memory_resource* memory, int count) {
  std::pmr::vector<Real> inverse(static_cast<size_t>(count), Real(1.0), memory);
  for (int k = 2; k < count; ++k) inverse[k] = Real(1.0) / Real(1.0 * k);
  return inverse;
}

// (sign s A)^k b / k!, one a row: the Taylor series of e^{sign A t} b in t / s.
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

// What happens within a time s: e^{A s} and the Gramian of s.
template <class Real>
struct Span {
  LaneMatrix<Real> e, w;
};

template <class Real>
Span<Real> makeShortSpan(const ControlProblem& system, const SparseRows& a, const Real& time, std::pmr::memory_resource* memory) {
  constexpr int kTerms = Precision<Real>::kShortTerms;
  const int n = system.size;
  const ScaledSystem<Real> scaled(memory, system, a, time);
  const std::pmr::vector<Real> inverse = makeInverses<Real>(memory, 2 * kTerms);
  const LaneMatrix<Real> one = LaneMatrix<Real>::identity(memory, n);
  LaneMatrix<Real> e = one.copy(), next(memory, n, n);
  for (int k = kTerms; k > 0; --k) {  // Horner
    scaled.multiply(e, inverse[k], &one, next);
    std::swap(e, next);
  }
  // With e^{A t} b = sum c_k (t/s)^k the integral of its square is s sum c_j c_k^T / (j + k + 1).
  const LaneMatrix<Real> impulse = makeImpulse<Real>(scaled, system, 1.0, inverse, kTerms, memory);
  LaneMatrix<Real> integral(memory, kTerms, kTerms);
  for (int j = 0; j < kTerms; ++j)
    for (int k = 0; k < kTerms; ++k) integral.set(j, k, time * inverse[j + k + 1]);
  return {std::move(e), transpose(impulse) * (integral * impulse)};
}

// W(2s) = W(s) + e^{A s} W(s) e^{A^T s}. What one doubling needs is kept for the next one.
template <class Real>
class Doubling {
 public:
  Doubling(std::pmr::memory_resource* memory, int size)
      : turned_(memory, size, size), product_(memory, size, size), sum_(memory, size, size) {}
  void apply(Span<Real>& span) {
    transpose(span.e, turned_);
    multiply(span.e, span.w, product_);
    multiply(product_, turned_, sum_);
    span.w += sum_;
    multiply(span.e, span.e, product_);
    std::swap(span.e, product_);
  }

 private:
  LaneMatrix<Real> turned_, product_, sum_;
};

// Right and left singular vectors of the coupling C of velocities and elongations, from those of C^T C; the left ones by themselves
// where some C v are too small to tell them. Each state is then about one mode of the object.
Eigen::MatrixXd makeTurn(const ControlProblem& system) {
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  constexpr double kTellsLeft = 1e-6;
  const int m = system.controlled, e = system.elongations, v = system.velocities;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(m, m), coupling(e, v);
  if (e == 0) return turn;
  for (int i = 0; i < e; ++i)
    for (int j = 0; j < v; ++j) coupling(i, j) = system.a[static_cast<size_t>(i) * system.size + e + j].hi;
  const Solver right(coupling.transpose() * coupling);
  turn.block(e, e, v, v) = right.eigenvectors();
  if (right.eigenvalues()[v - e] > kTellsLeft * right.eigenvalues()[v - 1])
    turn.topLeftCorner(e, e) = (coupling * right.eigenvectors().rightCols(e)).colwise().normalized();
  else turn.topLeftCorner(e, e) = Solver(coupling * coupling.transpose()).eigenvectors();
  return turn;
}

// Of a triangle; the smallest singular value as the largest of the inverse, so that it has its own digits.
template <class Real>
double computeCondition(const std::pmr::vector<Real>& l, Eigen::Index n) {
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n), inverse = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) factor(i, j) = leading(l[static_cast<size_t>(i * n + j)]);
  factor.triangularView<Eigen::Lower>().solveInPlace(inverse);
  if (!inverse.allFinite()) return std::numeric_limits<double>::infinity();
  const auto largest = [](const Eigen::MatrixXd& m) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m * m.transpose(), Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues()[m.rows() - 1]);
  };
  return largest(factor) * largest(inverse);
}

// Of the triangle of W, from W's own eigenvalues: up to the condition at which a double is enough they have ten digits.
double computeCondition(const LaneMatrix<double>& w) {
  Eigen::MatrixXd m(w.rows(), w.rows());
  for (int i = 0; i < w.rows(); ++i)
    for (int j = 0; j < w.rows(); ++j) m(i, j) = w.at(i, j);
  const Eigen::VectorXd sizes = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m, Eigen::EigenvaluesOnly).eigenvalues();
  return sizes[0] > 0 ? std::sqrt(sizes[sizes.size() - 1] / sizes[0]) : std::numeric_limits<double>::infinity();
}

// W factorised in the object's modes, its diagonal scaled to one.
template <class Real>
class Gramian {
 public:
  Gramian(const ControlProblem& system, const LaneMatrix<Real>& w)
      : m_(system.controlled), size_(system.size), turn_(makeTurn(system)), unit_(static_cast<size_t>(m_), w.memory()), l_(w.memory()) {
    LaneMatrix<Real> controlled(w.memory(), m_, m_);
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) controlled.set(i, j, w.at(i, j));
    LaneMatrix<Real> turned = LaneMatrix<Real>(w.memory(), turn_.transpose()) * (controlled * LaneMatrix<Real>(w.memory(), turn_));
    for (int i = 0; i < m_; ++i) unit_[i] = 1 / std::sqrt(leading(turned.at(i, i)));
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) turned.set(i, j, Real(unit_[i]) * turned.at(i, j) * unit_[j]);
    l_ = factoriseCholesky(turned);
    if constexpr (std::is_same_v<Real, double>) condition_ = computeCondition(turned);
    else condition_ = computeCondition(l_, m_);
  }

  double condition() const { return condition_; }
  struct Solution {
    std::vector<Real> weights;  // W^-1 x, zero for what only follows
    double energy = 0;          // x^T W^-1 x
  };
  Solution solve(const std::vector<Real>& x) const {
    std::vector<Real> y(static_cast<size_t>(m_), 0.0);
    Real energy = 0.0;
    for (int i = 0; i < m_; ++i) {
      for (int j = 0; j < m_; ++j) y[i] += Real(turn_(j, i)) * x[j];
      y[i] *= unit_[i];
      for (int j = 0; j < i; ++j) y[i] -= l(i, j) * y[j];
      y[i] /= l(i, i);
      energy += y[i] * y[i];
    }
    for (int i = m_; i-- > 0;) {
      for (int j = i + 1; j < m_; ++j) y[i] -= l(j, i) * y[j];
      y[i] /= l(i, i);
    }
    for (int i = 0; i < m_; ++i) y[i] *= unit_[i];
    Solution solution{std::vector<Real>(static_cast<size_t>(size_), 0.0), static_cast<double>(energy)};
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) solution.weights[i] += Real(turn_(i, j)) * y[j];
    return solution;
  }

 private:
  const Real& l(int i, int j) const { return l_[static_cast<size_t>(i) * m_ + j]; }

  int m_, size_;
  Eigen::MatrixXd turn_;
  std::pmr::vector<double> unit_;
  std::pmr::vector<Real> l_;
  double condition_ = 0;
};

int countTerms(double rate, double rounding) {
  double size = 1, largest = 1;
  int k = 0;
  while (size > rounding * largest || k < rate) {
    size *= rate / ++k;
    largest = std::max(largest, size);
  }
  return k + 1;
}

// The movement in equal time intervals, each by Taylor series about its middle, in the digits of Real. Eight intervals are a batch.
template <class Real>
class Movement {
 public:
  using Batch = BatchOf<Real>;
  Movement(const ControlProblem& system, const SparseRows& a, int intervals, double halfWidth, LaneMatrix<Real> half,
           const LaneMatrix<Real>& whole, double condition)
      : size_(system.size), count_(intervals), terms_(countTerms(a.norm() * halfWidth, kRounding / condition)), memory_(half.memory()),
        scaled_(memory_, system, a, halfWidth), inverse_(makeInverses<Real>(memory_, terms_ + 1)), half_(std::move(half)),
        halfTurned_(transpose(half_)), whole_(whole), gain_(makeImpulse<Real>(scaled_, system, -1.0, inverse_, terms_, memory_)),
        adjoint_(memory_, count_, size_), atBegin_(memory_, count_, size_), atEnd_(memory_, count_, size_), row_(memory_, 2, size_),
        lane_(memory_, 5 * 2 * size_, 1), control_(memory_, lanesFor<kBatchLanes>(count_) * terms_, kBatchLanes),
        state(memory_, count_, size_) {}

  // u = b^T adjoint, the adjoint backwards from `weights` at T; the states under it, from rest. What they arrive at.
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
  // The control of kCount batches from the interval `first` on, and the states under it from zero in the middle of each interval to both
  // of its ends.
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

// Each output by its few differences from the one before: neighbours in a chain share most of their row.
struct Difference {
  int output, state;  // state n is the control
  double factor;
};
std::vector<Difference> makeDifferences(const ControlProblem& system) {
  std::vector<Difference> differences;
  for (size_t o = 0; o < system.output.size(); ++o)
    for (int i = 0; i <= system.size; ++i) {
      const double factor = system.output[o][i].hi - (o > 0 ? system.output[o - 1][i].hi : 0.0);
      if (factor != 0) differences.push_back({static_cast<int>(o), i, factor});
    }
  return differences;
}

// Taylor series of the states and outputs in double, kCount batches of intervals side by side, from the interval `first` on.
template <int kCount, class Real>
void fillProfile(const ScaledSystem<double>& scaled, const std::vector<Difference>& differences, const std::pmr::vector<double>& inverse,
                 const Movement<Real>& movement, int first, LaneMatrix<double>& lanes, PiecewiseSeries& profile) {
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
PiecewiseSeries makeProfile(const ControlProblem& system, const SparseRows& a, const Movement<Real>& movement, int intervals,
                            double halfWidth, std::pmr::memory_resource* memory) {
  PiecewiseSeries profile(static_cast<int>(system.output.size()), countTerms(a.norm() * halfWidth, kRounding), intervals);
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

// In these digits; nullopt where they are too few.
template <class Real>
std::optional<MinimumEnergyMotion> solveIn(const ControlProblem& system, const SparseRows& a, double duration) {
  MinimumEnergyMotion motion;
  motion.fastest = a.norm();
  const int doublings = std::max(1, static_cast<int>(std::ceil(std::log2(motion.fastest * duration / kShort))));
  const int toHalf = std::min(doublings - 1, kHalfDoublings);
  std::pmr::monotonic_buffer_resource memory(kFirstMemory);
  Span<Real> span = makeShortSpan<Real>(system, a, std::ldexp(duration, -doublings), &memory);
  Doubling<Real> doubling(&memory, system.size);
  for (int i = 0; i < toHalf; ++i) doubling.apply(span);
  LaneMatrix<Real> half = span.e.copy();
  doubling.apply(span);
  const LaneMatrix<Real> whole = span.e.copy();
  for (int i = toHalf + 1; i < doublings; ++i) doubling.apply(span);

  // W carries the square of the condition into its inverse; what the movement misses the target by corrects that.
  const Gramian<Real> gramian(system, span.w);
  motion.condition = gramian.condition();
  if (std::is_same_v<Real, double> && !(motion.condition <= Precision<double>::kMaxCondition)) return std::nullopt;
  const int intervals = 1 << (doublings - toHalf - 1);
  const double halfWidth = duration / (2 * intervals);
  Movement<Real> movement(system, a, intervals, halfWidth, std::move(half), whole, std::clamp(motion.condition, 1.0, kRefuseCondition));
  std::vector<Real> target;
  target.reserve(system.target.size());
  for (const DoubleDouble& x : system.target) target.push_back(rounded<Real>(x));
  typename Gramian<Real>::Solution solution = gramian.solve(target);
  const double wanted = motion.condition < Precision<Real>::kNeedsNoCorrection
                            ? 0
                            : Precision<Real>::kCorrected * Precision<Real>::kCorrected * solution.energy;
  bool settled = false;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    std::vector<Real> missed = movement.follow(solution.weights);
    motion.miss = 0;
    for (int i = 0; i < system.controlled; ++i) {
      missed[i] = target[i] - missed[i];
      motion.miss = std::max(motion.miss, std::abs(leading(missed[i])));
    }
    settled = wanted == 0 || !std::isfinite(motion.miss);
    if (settled) break;
    const typename Gramian<Real>::Solution correction = gramian.solve(missed);
    settled = correction.energy <= wanted;
    if (settled) break;
    for (int i = 0; i < system.size; ++i) solution.weights[i] += correction.weights[i];
  }
  if (std::is_same_v<Real, double> && !(settled && std::isfinite(motion.miss))) return std::nullopt;
  Real cost = 0.0;
  for (int i = 0; i < system.controlled; ++i) cost += solution.weights[i] * target[i];
  motion.cost = static_cast<double>(cost);
  motion.profile = makeProfile(system, a, movement, intervals, halfWidth, &memory);
  return motion;
}

}  // namespace

MinimumEnergyMotion solveMinimumEnergy(const ControlProblem& system, double duration) {
  const SparseRows a(system);
  if (const double fastest = a.norm(); !(fastest * duration <= kFastestTimesDuration))
    throw RefusedError(
        fmt::format("the object's fastest rate, {:.3g} 1/s, is too stiff for a movement of {:.4g} s: less damping, "
                    "heavier masses or a shorter time",
                    fastest, duration));
  if (std::optional<MinimumEnergyMotion> motion = solveIn<double>(system, a, duration)) return *std::move(motion);
  return *solveIn<DoubleDouble>(system, a, duration);
}

}  // namespace reachlab::predict
