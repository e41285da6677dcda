#include "sim/predict/panel_factor.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sim/predict/gauss_legendre.h"

namespace reachlab::predict {
namespace {

constexpr int kNodes = 16, kPairs = kNodes / 2;
using Column = std::array<Pack, kNodes>;  // samples of one state in eight panels

// Columns about the object's modes: right and left singular vectors of the coupling C of velocities and elongations, from those of
// C^T C; the left ones by themselves where some C v are too small to tell them.
Eigen::MatrixXd makeTurn(const LineSystem<double>& system) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  constexpr double kTellsLeft = 1e-6;
  const int m = system.controlled, e = system.elongations, v = system.velocities;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(m, m);
  if (e == 0) return turn;
  const Eigen::MatrixXd coupling = Eigen::Map<const RowMajor>(system.a.data(), system.size, system.size).block(0, e, e, v);
  const Solver right(coupling.transpose() * coupling);
  turn.block(e, e, v, v) = right.eigenvectors();
  if (right.eigenvalues()[v - e] > kTellsLeft * right.eigenvalues()[v - 1])
    turn.topLeftCorner(e, e) = (coupling * right.eigenvectors().rightCols(e)).colwise().normalized();
  else turn.topLeftCorner(e, e) = Solver(coupling * coupling.transpose()).eigenvectors();
  return turn;
}

// Powers of the positive nodes over factorials, times the roots of the weights.
std::vector<std::array<double, kPairs>> makePowers(int terms, double halfWidth) {
  const GaussRule<double>& rule = gaussRule16();
  std::vector<std::array<double, kPairs>> power(static_cast<size_t>(terms));
  for (int g = 0; g < kPairs; ++g) {
    double p = std::sqrt(rule.weight[kPairs + g] * halfWidth);
    for (int k = 0; k < terms; p *= rule.node[kPairs + g] / ++k) power[k][g] = p;
  }
  return power;
}

// Even and odd terms by themselves give both nodes of a pair.
void sample(const PanelSeries<double>& series, int block, const std::vector<std::array<double, kPairs>>& power,
            std::vector<Column>& columns) {
  const int terms = series.terms();
  for (size_t i = 0; i < columns.size(); ++i) {
    std::array<Pack, kPairs> sums[2] = {};
    for (int odd = 0; odd < 2; ++odd) {
      std::array<Pack, kPairs> sum{};
      for (int k = odd; k < terms; k += 2)
        for (int g = 0; g < kPairs; ++g) addProduct(sum[g], power[k][g], series.of(block, k)[i]);
      sums[odd] = sum;
    }
    for (int g = 0; g < kPairs; ++g) columns[i][g] = sums[0][g] + sums[1][g], columns[i][kPairs + g] = sums[0][g] - sums[1][g];
  }
}

void turnColumns(std::vector<Column>& columns, const Eigen::MatrixXd& turn, int begin, int count) {
  std::vector<Column> turned(static_cast<size_t>(count));
  for (int j = 0; j < count; ++j) {
    Column sum{};
    for (int i = 0; i < count; ++i)
      for (int g = 0; g < kNodes; ++g) addProduct(sum[g], turn(begin + i, begin + j), columns[begin + i][g]);
    turned[j] = sum;
  }
  std::copy(turned.begin(), turned.end(), columns.begin() + begin);
}

double dot(const Column& a, const Column& b) {
  Pack parts[4] = {};  // independent sums do not wait for each other
  for (int g = 0; g < kNodes; ++g) parts[g % 4] += a[g] * b[g];
  const Pack sum = (parts[0] + parts[1]) + (parts[2] + parts[3]);
  std::array<double, kPack / 2> half;
  for (int i = 0; i < kPack / 2; ++i) half[i] = sum[i] + sum[i + kPack / 2];
  return (half[0] + half[2]) + (half[1] + half[3]);
}

// Takes further rows into the triangle: R^T R grows by their square. Householder reflections of one row of R and all of the new
// ones, Golub and Van Loan 12.5.
void absorb(Eigen::MatrixXd& r, std::vector<Column>& columns) {
  for (int k = 0; k < r.rows(); ++k) {
    const Column mine = columns[k];
    const double square = dot(mine, mine), corner = r(k, k);
    if (!(square > 0)) continue;
    const double alpha = corner > 0 ? -std::sqrt(corner * corner + square) : std::sqrt(corner * corner + square);
    const double first = corner - alpha, twice = 2 / (square + first * first);
    r(k, k) = alpha;
    for (int j = k + 1; j < r.rows(); ++j) {
      const double product = twice * (first * r(k, j) + dot(mine, columns[j]));
      r(k, j) -= product * first;
      for (int g = 0; g < kNodes; ++g) columns[j][g] -= product * mine[g];
    }
  }
}

// By the signs of the pivots of T - x I (Golub and Van Loan 8.4), T tridiagonal, for eight x between the bounds at a time.
double largestSingularValue(const Eigen::MatrixXd& m) {
  const Eigen::MatrixXd square = m * m.transpose();
  if (m.rows() == 1) return std::sqrt(square(0, 0));
  const Eigen::Tridiagonalization<Eigen::MatrixXd> tridiagonal(square);
  const Eigen::VectorXd diagonal = tridiagonal.diagonal(), beside = tridiagonal.subDiagonal().cwiseAbs2();
  double lo = diagonal.maxCoeff(), hi = square.trace();
  while (hi - lo > std::numeric_limits<double>::epsilon() * hi) {
    Pack x;
    for (int i = 0; i < kPack; ++i) x[i] = lo + (hi - lo) * (i + 1) / (kPack + 1);
    Pack pivot = diagonal[0] - x;
    auto isAboveAll = pivot < 0;
    for (Eigen::Index i = 1; i < diagonal.size(); ++i) {
      pivot = diagonal[i] - x - beside[i - 1] / pivot;
      isAboveAll &= pivot < 0;
    }
    const double before = hi - lo;
    for (int i = 0; i < kPack && lo < hi; ++i) {
      if (!isAboveAll[i]) lo = x[i];
      else if (x[i] < hi) hi = x[i];
    }
    if (!(hi - lo < before)) break;
  }
  return std::sqrt(hi);
}

// The smallest singular value as the inverse's largest.
double computeCondition(const Eigen::MatrixXd& factor) {
  const Eigen::MatrixXd unit = factor.colwise().normalized();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(unit.rows(), unit.cols());
  unit.triangularView<Eigen::Upper>().solveInPlace(inverse);
  if (!inverse.allFinite()) return std::numeric_limits<double>::infinity();
  return largestSingularValue(unit) * largestSingularValue(inverse);
}

}  // namespace

PanelFactor::PanelFactor(const LineSystem<double>& system, const PanelGrid& grid, const PanelSeries<double>& series)
    : turn_(makeTurn(system)), factor_(Eigen::MatrixXd::Zero(system.controlled, system.controlled)) {
  const auto power = makePowers(series.terms(), grid.halfWidth);
  std::vector<Column> columns(static_cast<size_t>(system.controlled));
  for (int block = 0; block < grid.blocks(); ++block) {
    sample(series, block, power, columns);
    turnColumns(columns, turn_, 0, system.elongations);
    turnColumns(columns, turn_, system.elongations, system.velocities);
    absorb(factor_, columns);
  }
  condition_ = computeCondition(factor_);
}

PanelFactor::Solution PanelFactor::solve(const Eigen::VectorXd& x) const {
  Solution solution{turn_.transpose() * x, 0};
  factor_.triangularView<Eigen::Upper>().transpose().solveInPlace(solution.l);
  solution.size = solution.l.norm();
  factor_.triangularView<Eigen::Upper>().solveInPlace(solution.l);
  solution.l = turn_ * solution.l;
  return solution;
}

}  // namespace reachlab::predict
