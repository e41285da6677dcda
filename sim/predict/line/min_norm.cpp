#include "sim/predict/line/min_norm.h"

#include <algorithm>
#include <cmath>

#include "base/math/eigen_solvers.h"
#include "base/math/gauss_legendre.h"
#include "constraints/formula/sincos.h"

namespace reachlab::predict {
namespace {

// Sixteen Gauss nodes integrate the square of a wave to rounding while its phase W tau turns by no more than this within a interval.
constexpr double kPhasePerInterval = 8;

// Of a triangle. Its square's eigenvalues, which are cheap, have ten digits of the smallest one up to this condition.
constexpr double kSquareTells = 1e3;
double computeCondition(const Eigen::MatrixXd& r) {
  const Eigen::VectorXd squares = symmetricEigenvalues(r.transpose() * r);
  const double least = squares(0), most = squares(squares.size() - 1);
  if (most <= kSquareTells * kSquareTells * least) return std::sqrt(most / least);
  const Eigen::VectorXd sizes = singularValues(r);
  return sizes(0) / sizes(sizes.size() - 1);
}

}  // namespace

MinNormMotion solveMinNorm(int order, double distance, double halfTime, const Eigen::VectorXd& frequency) {
  const bool even = order % 2 == 1;
  const Eigen::Index polynomials = even ? (order + 1) / 2 : order / 2;
  const Eigen::Index unknowns = polynomials + frequency.size();
  const double fastest = frequency.size() > 0 ? frequency.maxCoeff() : 0.0;
  const GaussRule& rule = gaussRule16();
  const auto points = static_cast<Eigen::Index>(rule.node.size());
  const auto intervals =
      static_cast<Eigen::Index>(std::ceil(std::max({fastest * halfTime / kPhasePerInterval, static_cast<double>(unknowns) / 12, 1.0})));
  const double width = halfTime / static_cast<double>(intervals);

  Eigen::MatrixXd basis(intervals * points, unknowns);
  for (Eigen::Index row = 0; row < basis.rows(); ++row) {
    const double tau = width * (static_cast<double>(row / points) + (rule.node[row % points] + 1) / 2);
    const double root = std::sqrt(width * rule.weight[row % points]);  // the other half of the interval doubles the weight
    const double s = tau / halfTime;
    double p0 = 1, p1 = s;
    for (int k = 0; k < order; ++k) {
      if (k % 2 == (even ? 0 : 1)) basis(row, k / 2) = root * p0;
      const double p2 = ((2 * k + 3) * s * p1 - (k + 1) * p0) / (k + 2);
      p0 = p1, p1 = p2;
    }
    for (Eigen::Index j = 0; j < frequency.size(); ++j)
      basis(row, polynomials + j) = root * (even ? constraints::cosine(frequency(j) * tau) : constraints::sine(frequency(j) * tau));
  }

  const Eigen::VectorXd scale = basis.colwise().norm().cwiseInverse();
  basis *= scale.asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  const Eigen::MatrixXd r = qr.matrixQR().topRows(unknowns).triangularView<Eigen::Upper>();

  // int g P_(r-1) dtau = lead * (-1)^(r-1) (r-1)! L / H^(r-1), lead the leading coefficient of P_(r-1); all other products
  // vanish.
  double right = distance;
  for (int k = 1; k < order; ++k) right *= -static_cast<double>(2 * k - 1) / halfTime;
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(unknowns);
  rhs(polynomials - 1) = right * scale(polynomials - 1);
  Eigen::VectorXd c = r.triangularView<Eigen::Upper>().transpose().solve(rhs);
  r.triangularView<Eigen::Upper>().solveInPlace(c);
  c = c.cwiseProduct(scale);

  return {.order = order,
          .halfTime = halfTime,
          .polynomial = c.head(polynomials),
          .trig = c.tail(frequency.size()),
          .cost = right * c(polynomials - 1),
          .condition = computeCondition(r)};
}

}  // namespace reachlab::predict
