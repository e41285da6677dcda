#include "sim/predict/line/minimum_energy.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "sim/predict/condition.h"
#include "sim/predict/line/sparse_rows.h"
#include "sim/predict/numerics/wide_matrix.h"

namespace reachlab::predict {
namespace {

constexpr double kShort = 0.5;       // fastest rate times the time that the doubling starts from
constexpr int kGramianTerms = 33;    // of that of W: 1 / 33! < 1e-32
constexpr int kShortTerms = 25;      // of the Taylor series there: 0.5^25 / 25! < 1e-32
constexpr int kHalfDoublings = 3;    // from there to half an interval of the profile: rate times half an interval is 4 at most
constexpr double kRounding = 1e-17;  // what is left out of the profile's Taylor series

constexpr double kNeedsNoCorrection = 1e5, kCorrected = 1e-15;  // condition; part of the control
constexpr int kMaxPasses = 4;

// What happens within a time s: e^{A s} and the Gramian of s.
struct Span {
  WideMatrix e, w;
};

// to = factor (A m), row by row.
WideMatrix multiplySparse(const SparseRows& a, const WideMatrix& m, const DoubleDouble& factor) {
  WideMatrix product(m.rows(), m.columns());
  for (int i = 0; i < m.rows(); ++i)
    for (int p = a.begin[i]; p < a.begin[i + 1]; ++p) {
      const DoubleDouble entry = factor * a.value[p];
      for (int b = 0; b < m.batches(); ++b) addProduct(product.row(i)[b], entry, m.row(a.column[p])[b]);
    }
  for (int i = 0; i < m.rows(); ++i)
    for (int b = 0; b < m.batches(); ++b) settle(product.row(i)[b]);
  return product;
}

Span makeShortSpan(const ControlProblem& system, const SparseRows& a, const DoubleDouble& time) {
  const int n = system.size;
  const auto part = [&](int k) { return time / DoubleDouble(1.0 * k); };
  Span span{WideMatrix::identity(n), WideMatrix(n, n)};
  for (int k = kShortTerms; k > 0; --k) {  // Horner
    span.e = multiplySparse(a, span.e, part(k));
    for (int i = 0; i < n; ++i) span.e.set(i, i, span.e.at(i, i) + 1.0);
  }
  // Terms of W: h b b^T, then h / (k+1) times A P + (A P)^T of the one before.
  WideMatrix term(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) term.set(i, j, time * system.b[i] * system.b[j]);
  for (int k = 2; k < kGramianTerms; ++k) {
    span.w += term;
    const WideMatrix half = multiplySparse(a, term, part(k));
    term = transpose(half);
    term += half;
  }
  return span;
}

void doubleTime(Span& span) {
  span.w += span.e * span.w * transpose(span.e);
  span.e = span.e * span.e;
}

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
double computeCondition(const std::vector<std::vector<DoubleDouble>>& l) {
  const auto n = static_cast<Eigen::Index>(l.size());
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(n, n), inverse = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) factor(i, j) = l[static_cast<size_t>(i)][static_cast<size_t>(j)].hi;
  factor.triangularView<Eigen::Lower>().solveInPlace(inverse);
  if (!inverse.allFinite()) return std::numeric_limits<double>::infinity();
  const auto largest = [](const Eigen::MatrixXd& m) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m * m.transpose(), Eigen::EigenvaluesOnly);
    return std::sqrt(solver.eigenvalues()[m.rows() - 1]);
  };
  return largest(factor) * largest(inverse);
}

// W factorised in the object's modes, its diagonal scaled to one.
class Gramian {
 public:
  Gramian(const ControlProblem& system, const WideMatrix& w)
      : m_(system.controlled), size_(system.size), turn_(makeTurn(system)), unit_(static_cast<size_t>(m_)) {
    WideMatrix controlled(m_, m_);
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) controlled.set(i, j, w.at(i, j));
    WideMatrix turned = WideMatrix(Eigen::MatrixXd(turn_.transpose())) * controlled * WideMatrix(turn_);
    for (int i = 0; i < m_; ++i) unit_[i] = 1 / std::sqrt(turned.at(i, i).hi);
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) turned.set(i, j, DoubleDouble(unit_[i]) * turned.at(i, j) * unit_[j]);
    l_ = factoriseCholesky(turned);
    condition_ = computeCondition(l_);
  }

  double condition() const { return condition_; }
  struct Solution {
    std::vector<DoubleDouble> weights;  // W^-1 x, zero for what only follows
    double energy = 0;                  // x^T W^-1 x
  };
  Solution solve(const std::vector<DoubleDouble>& x) const {
    std::vector<DoubleDouble> y(static_cast<size_t>(m_), 0.0);
    DoubleDouble energy = 0.0;
    for (int i = 0; i < m_; ++i) {
      for (int j = 0; j < m_; ++j) y[i] += DoubleDouble(turn_(j, i)) * x[j];
      y[i] *= unit_[i];
      for (int j = 0; j < i; ++j) y[i] -= l_[i][j] * y[j];
      y[i] /= l_[i][i];
      energy += y[i] * y[i];
    }
    for (int i = m_; i-- > 0;) {
      for (int j = i + 1; j < m_; ++j) y[i] -= l_[j][i] * y[j];
      y[i] /= l_[i][i];
    }
    Solution solution{std::vector<DoubleDouble>(static_cast<size_t>(size_), 0.0), static_cast<double>(energy)};
    for (int i = 0; i < m_; ++i)
      for (int j = 0; j < m_; ++j) solution.weights[i] += DoubleDouble(turn_(i, j)) * (y[j] * unit_[j]);
    return solution;
  }

 private:
  int m_, size_;
  Eigen::MatrixXd turn_;
  std::vector<double> unit_;
  std::vector<std::vector<DoubleDouble>> l_;
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

// The movement in equal time intervals, each by Taylor series about its middle, in 32 digits.
class Movement {
 public:
  Movement(const ControlProblem& system, const SparseRows& a, int intervals, double halfWidth, WideMatrix half, const WideMatrix& whole,
           double condition)
      : system_(system), a_(a), count_(intervals), half_(std::move(half)), halfTurned_(transpose(half_)), whole_(whole),
        gain_(system.size, countTerms(a.norm() * halfWidth, kRounding / condition)), control(intervals, gain_.columns()),
        state(intervals, system.size) {
    for (const DoubleDouble& value : a.value) entry_.push_back(value * halfWidth);
    for (const DoubleDouble& value : system.b) drive_.push_back(value * halfWidth);
    for (int k = 1; k <= gain_.columns(); ++k) inverse_.push_back(DoubleDouble(1.0) / DoubleDouble(1.0 * k));
    WideMatrix term(system.size, 1);  // of the adjoint in the control's terms: (-half A)^k b / k!
    for (int i = 0; i < system.size; ++i) term.set(i, 0, system.b[i]);
    for (int k = 0; k < gain_.columns(); ++k) {
      for (int i = 0; i < system.size; ++i) gain_.set(i, k, term.at(i, 0));
      term = multiplySparse(a, term, DoubleDouble(-halfWidth) * inverse_[k]);
    }
  }

  // u = b^T adjoint, the adjoint backwards from `weights` at T; the states under it, from rest. What they arrive at.
  std::vector<DoubleDouble> follow(const std::vector<DoubleDouble>& weights) {
    const int n = system_.size;
    WideMatrix adjoint(count_, n), row(1, n), border(1, n), arrived(1, n);
    for (int i = 0; i < n; ++i) row.set(0, i, weights[i]);
    multiplyRow(row.row(0), half_, nullptr, adjoint.row(count_ - 1));
    for (int p = count_ - 1; p > 0; --p) multiplyRow(adjoint.row(p), whole_, nullptr, adjoint.row(p - 1));
    control = adjoint * gain_;
    WideMatrix atBegin(count_, n), atEnd(count_, n);
    respond(atBegin, atEnd);
    for (int p = 0; p < count_; ++p) {  // x(begin) = e^{-A half} x(middle) + what the control adds from there on
      for (int i = 0; i < n; ++i) border.set(0, i, arrived.at(0, i) - atBegin.at(p, i));
      multiplyRow(border.row(0), halfTurned_, nullptr, state.row(p));
      multiplyRow(state.row(p), halfTurned_, atEnd.row(p), arrived.row(0));
    }
    std::vector<DoubleDouble> end;
    for (int i = 0; i < n; ++i) end.push_back(arrived.at(0, i));
    return end;
  }

 private:
  // From zero in the middle of each interval, eight of them side by side, to both of its ends.
  void respond(WideMatrix& atBegin, WideMatrix& atEnd) const {
    const int n = system_.size;
    const WideBatch plus{LaneBatch{} + 1.0, LaneBatch{}}, minus{LaneBatch{} - 1.0, LaneBatch{}};
    std::vector<WideBatch> x(static_cast<size_t>(n)), next(x), begin(x), end(x);
    for (int first = 0; first < count_; first += kLanes) {
      const int lanes = std::min(kLanes, count_ - first);
      for (int i = 0; i < n; ++i) x[i] = begin[i] = end[i] = WideBatch{};
      for (int k = 0; k + 1 < gain_.columns(); ++k) {
        WideBatch u{};
        for (int lane = 0; lane < lanes; ++lane) setLane(u, lane, control.at(first + lane, k));
        for (int i = 0; i < n; ++i) {
          WideBatch sum{}, term{};
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
  WideMatrix half_, halfTurned_, whole_, gain_;
  std::vector<DoubleDouble> entry_, drive_, inverse_;

 public:
  WideMatrix control;  // Taylor coefficients over half an interval, in rows
  WideMatrix state;    // in the middles, in rows
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
PiecewiseSeries makeProfile(const ControlProblem& system, const SparseRows& a, const Movement& movement, int intervals, double halfWidth) {
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
  for (int first = 0; first < intervals; first += kLanes) {
    const int count = std::min(kLanes, intervals - first);
    for (int i = 0; i < n; ++i)
      for (int lane = 0; lane < kLanes; ++lane) x[i][lane] = lane < count ? movement.state.at(first + lane, i).hi : 0.0;
    for (int k = 0; k < terms; ++k) {
      LaneBatch u{};
      for (int lane = 0; lane < count; ++lane) u[lane] = movement.control.at(first + lane, k).hi;
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

}  // namespace

MinimumEnergyMotion solveMinimumEnergy(const ControlProblem& system, double duration) {
  const SparseRows a(system);
  MinimumEnergyMotion motion;
  motion.fastest = a.norm();
  if (!(motion.fastest * duration <= kFastestTimesDuration))
    throw RefusedError(
        fmt::format("the object's fastest rate, {:.3g} 1/s, is too stiff for a movement of {:.4g} s: less damping or "
                    "heavier masses",
                    motion.fastest, duration));
  const int doublings = std::max(1, static_cast<int>(std::ceil(std::log2(motion.fastest * duration / kShort))));
  const int toHalf = std::min(doublings - 1, kHalfDoublings);
  Span span = makeShortSpan(system, a, DoubleDouble(std::ldexp(duration, -doublings)));
  for (int i = 0; i < toHalf; ++i) doubleTime(span);
  const WideMatrix half = span.e;
  doubleTime(span);
  const WideMatrix whole = span.e;
  for (int i = toHalf + 1; i < doublings; ++i) doubleTime(span);

  // W carries the square of the condition into its inverse; what the movement misses the target by corrects that.
  const Gramian gramian(system, span.w);
  const int intervals = 1 << (doublings - toHalf - 1);
  const double halfWidth = duration / (2 * intervals);
  Movement movement(system, a, intervals, halfWidth, half, whole, std::clamp(gramian.condition(), 1.0, kRefuseCondition));
  Gramian::Solution solution = gramian.solve(system.target);
  motion.condition = gramian.condition();
  const double wanted = motion.condition < kNeedsNoCorrection ? 0 : kCorrected * kCorrected * solution.energy;
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    std::vector<DoubleDouble> missed = movement.follow(solution.weights);
    motion.miss = 0;
    for (int i = 0; i < system.controlled; ++i) {
      missed[i] = system.target[i] - missed[i];
      motion.miss = std::max(motion.miss, std::abs(missed[i].hi));
    }
    if (wanted == 0 || !std::isfinite(motion.miss)) break;
    const Gramian::Solution correction = gramian.solve(missed);
    if (correction.energy <= wanted) break;
    for (int i = 0; i < system.size; ++i) solution.weights[i] += correction.weights[i];
  }
  DoubleDouble cost = 0.0;
  for (int i = 0; i < system.controlled; ++i) cost += solution.weights[i] * system.target[i];
  motion.cost = static_cast<double>(cost);
  motion.profile = makeProfile(system, a, movement, intervals, halfWidth);
  return motion;
}

}  // namespace reachlab::predict
