#include "sim/predict/line/minimum_energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include "base/error.h"
#include "base/matrix.h"
#include "sim/predict/condition.h"
#include "sim/predict/line/sparse_rows.h"
#include "sim/predict/numerics/lane_matrix.h"

namespace reachlab::predict {
namespace {

constexpr double kShort = 0.5;       // fastest rate times the time that the doubling starts from
constexpr int kHalfDoublings = 3;    // from there to half an interval of the profile: rate times half an interval is 4 at most
constexpr double kRounding = 1e-17;  // what is left out of the profile's Taylor series

constexpr int kMaxPasses = 4;

// What the digits of the arithmetic ask for.
template <class Real>
struct Precision;
template <>
struct Precision<double> {
  static constexpr int kGramianTerms = 19;  // of the Taylor series of W: 1 / 19! < 1e-17
  static constexpr int kShortTerms = 15;    // of that of e^{A s}: 0.5^15 / 15! < 1e-16
  static constexpr double kMaxCondition = 1e3, kNeedsNoCorrection = 0, kCorrected = 1e-12;
};
template <>
struct Precision<DoubleDouble> {
  static constexpr int kGramianTerms = 33, kShortTerms = 25;  // < 1e-32
  // Condition below which no correction is asked for, and the part of the control that is none.
  static constexpr double kNeedsNoCorrection = 1e5, kCorrected = 1e-15;
};

template <class Real>
Real rounded(const DoubleDouble& x) {
  if constexpr (std::is_same_v<Real, double>) return x.hi;
  else return x;
}

// What happens within a time s: e^{A s} and the Gramian of s.
template <class Real>
struct Span {
  LaneMatrix<Real> e, w;
};

// to = factor (A m), row by row; `to` is not m.
template <class Real>
void multiplySparse(const SparseRows& a, const LaneMatrix<Real>& m, const Real& factor, LaneMatrix<Real>& to) {
  for (int i = 0; i < m.rows(); ++i) {
    BatchOf<Real>* row = to.row(i);
    std::fill(row, row + m.batches(), BatchOf<Real>{});
    for (int p = a.begin[i]; p < a.begin[i + 1]; ++p) {
      const Real entry = factor * rounded<Real>(a.value[p]);
      for (int b = 0; b < m.batches(); ++b) addProduct(row[b], entry, m.row(a.column[p])[b]);
    }
    for (int b = 0; b < m.batches(); ++b) settle(row[b]);
  }
}

template <class Real>
Span<Real> makeShortSpan(const ControlProblem& system, const SparseRows& a, const Real& time) {
  const int n = system.size;
  const auto part = [&](int k) { return time / Real(1.0 * k); };
  Span<Real> span{LaneMatrix<Real>::identity(n), LaneMatrix<Real>(n, n)};
  LaneMatrix<Real> half(n, n), term(n, n);
  for (int k = Precision<Real>::kShortTerms; k > 0; --k) {  // Horner
    multiplySparse(a, span.e, part(k), half);
    std::swap(span.e, half);
    for (int i = 0; i < n; ++i) span.e.set(i, i, span.e.at(i, i) + 1.0);
  }
  // Terms of W: h b b^T, then h / (k+1) times A P + (A P)^T of the one before.
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) term.set(i, j, time * rounded<Real>(system.b[i]) * rounded<Real>(system.b[j]));
  for (int k = 2; k < Precision<Real>::kGramianTerms; ++k) {
    span.w += term;
    multiplySparse(a, term, part(k), half);
    transpose(half, term);
    term += half;
  }
  return span;
}

// W(2s) = W(s) + e^{A s} W(s) e^{A^T s}. What one doubling needs is kept for the next one.
template <class Real>
class Doubling {
 public:
  explicit Doubling(int size) : turned_(size, size), product_(turned_), sum_(turned_) {}
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
double computeCondition(const std::vector<std::vector<Real>>& l) {
  const auto n = static_cast<Eigen::Index>(l.size());
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n), inverse = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) factor(i, j) = leading(l[static_cast<size_t>(i)][static_cast<size_t>(j)]);
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
      : m_(system.controlled), size_(system.size), turn_(makeTurn(system)), unit_(static_cast<size_t>(m_)) {
    LaneMatrix<Real> controlled(m_, m_);
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) controlled.set(i, j, w.at(i, j));
    LaneMatrix<Real> turned = LaneMatrix<Real>(Eigen::MatrixXd(turn_.transpose())) * controlled * LaneMatrix<Real>(turn_);
    for (int i = 0; i < m_; ++i) unit_[i] = 1 / std::sqrt(leading(turned.at(i, i)));
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) turned.set(i, j, Real(unit_[i]) * turned.at(i, j) * unit_[j]);
    l_ = factoriseCholesky(turned);
    if constexpr (std::is_same_v<Real, double>) condition_ = computeCondition(turned);
    else condition_ = computeCondition(l_);
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
      for (int j = 0; j < i; ++j) y[i] -= l_[i][j] * y[j];
      y[i] /= l_[i][i];
      energy += y[i] * y[i];
    }
    for (int i = m_; i-- > 0;) {
      for (int j = i + 1; j < m_; ++j) y[i] -= l_[j][i] * y[j];
      y[i] /= l_[i][i];
    }
    Solution solution{std::vector<Real>(static_cast<size_t>(size_), 0.0), static_cast<double>(energy)};
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) solution.weights[i] += Real(turn_(i, j)) * (y[j] * unit_[j]);
    return solution;
  }

 private:
  int m_, size_;
  Eigen::MatrixXd turn_;
  std::vector<double> unit_;
  std::vector<std::vector<Real>> l_;
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

// The movement in equal time intervals, each by Taylor series about its middle, in the digits of Real.
template <class Real>
class Movement {
 public:
  Movement(const ControlProblem& system, const SparseRows& a, int intervals, double halfWidth, LaneMatrix<Real> half,
           const LaneMatrix<Real>& whole, double condition)
      : system_(system), a_(a), count_(intervals), half_(std::move(half)), halfTurned_(transpose(half_)), whole_(whole),
        gain_(system.size, countTerms(a.norm() * halfWidth, kRounding / condition)), control(intervals, gain_.columns()),
        state(intervals, system.size) {
    for (const DoubleDouble& value : a.value) entry_.push_back(rounded<Real>(value) * halfWidth);
    for (const DoubleDouble& value : system.b) drive_.push_back(rounded<Real>(value) * halfWidth);
    for (int k = 1; k <= gain_.columns(); ++k) inverse_.push_back(Real(1.0) / Real(1.0 * k));
    LaneMatrix<Real> term(system.size, 1), next(term);  // of the adjoint in the control's terms: (-half A)^k b / k!
    for (int i = 0; i < system.size; ++i) term.set(i, 0, rounded<Real>(system.b[i]));
    for (int k = 0; k < gain_.columns(); ++k) {
      for (int i = 0; i < system.size; ++i) gain_.set(i, k, term.at(i, 0));
      multiplySparse(a, term, Real(-halfWidth) * inverse_[k], next);
      std::swap(term, next);
    }
  }

  // u = b^T adjoint, the adjoint backwards from `weights` at T; the states under it, from rest. What they arrive at.
  std::vector<Real> follow(const std::vector<Real>& weights) {
    const int n = system_.size;
    LaneMatrix<Real> adjoint(count_, n), row(1, n), border(1, n), arrived(1, n);
    for (int i = 0; i < n; ++i) row.set(0, i, weights[i]);
    multiplyRow(row.row(0), half_, nullptr, adjoint.row(count_ - 1));
    for (int p = count_ - 1; p > 0; --p) multiplyRow(adjoint.row(p), whole_, nullptr, adjoint.row(p - 1));
    control = adjoint * gain_;
    LaneMatrix<Real> atBegin(count_, n), atEnd(count_, n);
    respond(atBegin, atEnd);
    for (int p = 0; p < count_; ++p) {  // x(begin) = e^{-A half} x(middle) + what the control adds from there on
      for (int i = 0; i < n; ++i) border.set(0, i, arrived.at(0, i) - atBegin.at(p, i));
      multiplyRow(border.row(0), halfTurned_, nullptr, state.row(p));
      multiplyRow(state.row(p), halfTurned_, atEnd.row(p), arrived.row(0));
    }
    std::vector<Real> end;
    for (int i = 0; i < n; ++i) end.push_back(arrived.at(0, i));
    return end;
  }

 private:
  // From zero in the middle of each interval, eight of them side by side, to both of its ends.
  void respond(LaneMatrix<Real>& atBegin, LaneMatrix<Real>& atEnd) const {
    const int n = system_.size;
    const Real plus = 1.0, minus = -1.0;
    std::vector<BatchOf<Real>> x(static_cast<size_t>(n)), next(x), begin(x), end(x);
    for (int first = 0; first < count_; first += kBatchLanes) {
      const int lanes = std::min(kBatchLanes, count_ - first);
      for (int i = 0; i < n; ++i) x[i] = begin[i] = end[i] = BatchOf<Real>{};
      for (int k = 0; k + 1 < gain_.columns(); ++k) {
        BatchOf<Real> u{};
        for (int lane = 0; lane < lanes; ++lane) setLane(u, lane, control.at(first + lane, k));
        for (int i = 0; i < n; ++i) {
          BatchOf<Real> sum{}, term{};
          addProduct(sum, drive_[i], u);
          for (int p = a_.begin[i]; p < a_.begin[i + 1]; ++p) addProduct(sum, entry_[p], x[a_.column[p]]);
          settle(sum);
          addProduct(term, inverse_[k], sum);
          settle(term);
          next[i] = term;
          addProduct(end[i], plus, term);
          addProduct(begin[i], k % 2 ? plus : minus, term);
        }
        x.swap(next);
      }
      for (int i = 0; i < n; ++i) {
        settle(begin[i]), settle(end[i]);
        for (int lane = 0; lane < lanes; ++lane) {
          atBegin.set(first + lane, i, laneOf(begin[i], lane));
          atEnd.set(first + lane, i, laneOf(end[i], lane));
        }
      }
    }
  }

  const ControlProblem& system_;
  const SparseRows& a_;
  int count_;
  LaneMatrix<Real> half_, halfTurned_, whole_, gain_;
  std::vector<Real> entry_, drive_, inverse_;

 public:
  LaneMatrix<Real> control;  // Taylor coefficients over half an interval, in rows
  LaneMatrix<Real> state;    // in the middles, in rows
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

// Taylor series of the states and outputs in double, eight intervals side by side.
template <class Real>
PiecewiseSeries makeProfile(const ControlProblem& system, const SparseRows& a, const Movement<Real>& movement, int intervals,
                            double halfWidth) {
  const int n = system.size, terms = countTerms(a.norm() * halfWidth, kRounding);
  PiecewiseSeries profile;
  profile.outputs = static_cast<int>(system.output.size());
  profile.terms = terms;
  profile.intervals = intervals;
  profile.width = 2 * halfWidth;
  profile.centre = 0.5;
  profile.coefficient.resize(static_cast<size_t>(intervals) * profile.outputs * terms);
  const std::vector<Difference> differences = makeDifferences(system);
  std::vector<double> entry, drive;
  for (const DoubleDouble& value : a.value) entry.push_back(value.hi * halfWidth);
  for (const DoubleDouble& value : system.b) drive.push_back(value.hi * halfWidth);
  std::vector<LaneBatch> x(static_cast<size_t>(n)), next(x);
  for (int first = 0; first < intervals; first += kBatchLanes) {
    const int count = std::min(kBatchLanes, intervals - first);
    for (int i = 0; i < n; ++i)
      for (int lane = 0; lane < kBatchLanes; ++lane) x[i][lane] = lane < count ? leading(movement.state.at(first + lane, i)) : 0.0;
    for (int k = 0; k < terms; ++k) {
      LaneBatch u{};
      for (int lane = 0; lane < count; ++lane) u[lane] = leading(movement.control.at(first + lane, k));
      LaneBatch position{};
      const double unit = std::ldexp(1.0, k);  // the profile counts in whole intervals
      auto difference = differences.begin();
      for (int o = 0; o < profile.outputs; ++o) {
        for (; difference != differences.end() && difference->output == o; ++difference)
          position += difference->factor * (difference->state < n ? x[difference->state] : u);
        for (int lane = 0; lane < count; ++lane)
          profile.coefficient[(static_cast<size_t>(first + lane) * profile.outputs + o) * terms + k] = unit * position[lane];
      }
      for (int i = 0; i < n; ++i) {
        LaneBatch sum = drive[i] * u;
        for (int p = a.begin[i]; p < a.begin[i + 1]; ++p) sum += entry[p] * x[a.column[p]];
        next[i] = sum / (k + 1.0);
      }
      x.swap(next);
    }
  }
  return profile;
}

// In these digits; nullopt where they are too few.
template <class Real>
std::optional<MinimumEnergyMotion> solveIn(const ControlProblem& system, const SparseRows& a, double duration) {
  MinimumEnergyMotion motion;
  motion.fastest = a.norm();
  const int doublings = std::max(1, static_cast<int>(std::ceil(std::log2(motion.fastest * duration / kShort))));
  const int toHalf = std::min(doublings - 1, kHalfDoublings);
  Span<Real> span = makeShortSpan<Real>(system, a, std::ldexp(duration, -doublings));
  Doubling<Real> doubling(system.size);
  for (int i = 0; i < toHalf; ++i) doubling.apply(span);
  const LaneMatrix<Real> half = span.e;
  doubling.apply(span);
  const LaneMatrix<Real> whole = span.e;
  for (int i = toHalf + 1; i < doublings; ++i) doubling.apply(span);

  // W carries the square of the condition into its inverse; what the movement misses the target by corrects that.
  const Gramian<Real> gramian(system, span.w);
  motion.condition = gramian.condition();
  if (std::is_same_v<Real, double> && !(motion.condition <= Precision<double>::kMaxCondition)) return std::nullopt;
  const int intervals = 1 << (doublings - toHalf - 1);
  const double halfWidth = duration / (2 * intervals);
  Movement<Real> movement(system, a, intervals, halfWidth, half, whole, std::clamp(motion.condition, 1.0, kRefuseCondition));
  std::vector<Real> target;
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
  motion.profile = makeProfile(system, a, movement, intervals, halfWidth);
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
