#include "sim/dynamics/systems/quadric.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/math/eigen_solvers.h"
#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/polynomial.h"

namespace reachlab::dynamics {
namespace {

constexpr int kAcross = 12;          // samples along u and v
constexpr double kVanishes = 1e-13;  // of the largest singular value: rounding of 144 sums of ten terms
constexpr double kUnique = 1e-7;     // the next singular value must stand clear of that

double sampleAt(const constraints::Domain& domain, double start, double fraction) {
  const double lo = std::isfinite(domain.lo) ? domain.lo : start - 3, hi = std::isfinite(domain.hi) ? domain.hi : start + 3;
  return lo + (hi - lo) * fraction;
}

constexpr double kRound = 1e-13;            // of A: as round as ten fitted coefficients can be
constexpr double kNone = 1e-6, kOn = 1e-9;  // of the gradient, which is of order one; [m] from the surface

/// The place d where the gradient vanishes, or comes nearest to it.
Eigen::Vector3d flattest(const Quadric& q, Eigen::Matrix3d& a, Eigen::Vector3d& b) {
  a << q.a[0], q.a[3], q.a[4], q.a[3], q.a[1], q.a[5], q.a[4], q.a[5], q.a[2];
  b << q.b.x, q.b.y, q.b.z;
  return (2 * a).colPivHouseholderQr().solve(-b);
}

// Ten fitted coefficients tell a cone from a hyperboloid with a narrow waist only down to their rounding, and a cylinder has no apex.
bool isCone(const Quadric& q) {
  constexpr double kRounding = 1e-12;  // of the size, which is about 1/|A|
  Eigen::Matrix3d a;
  Eigen::Vector3d b;
  const Eigen::Vector3d d = flattest(q, a, b);
  const Eigen::VectorXd singular = singularValues(a);
  return singular(2) > kNone * singular(0) && std::abs(d.dot(a * d) + b.dot(d) + q.c) * singular(0) <= kRounding;
}

/// A cone about its apex: b = 0 and c = 0. A fitted b and c would make it a hyperboloid with a waist of 1e-13 m, round which a mass turns.
void putApexFirst(Quadric& q, double size) {
  constexpr double kRounding = 1e-13;  // of the size
  Eigen::Matrix3d a;
  Eigen::Vector3d b;
  const Eigen::Vector3d d = flattest(q, a, b);
  q.centre += Vec3{d.x(), d.y(), d.z()};
  for (double* x : {&q.centre.x, &q.centre.y, &q.centre.z})
    if (std::abs(*x) < kRounding * size) *x = 0;
  q.b = {};
  q.c = 0;
}

constexpr int kTerms = 10;
// In long double, which Eigen never computes in lanes: the same law, to the bit, on every processor.
using Real = long double;
using Monomials = Eigen::Matrix<Real, Eigen::Dynamic, kTerms>;

/// The right singular vector of the smallest singular value, if that one vanishes and no other does. A QR decomposition, then Jacobi
/// rotations: bit by bit what Eigen::JacobiSVD does, which with its left singular vectors takes half a minute to compile.
std::optional<Eigen::Matrix<double, kTerms, 1>> findNullVector(const Monomials& monomials) {
  const Real scale = monomials.cwiseAbs().maxCoeff();
  const Eigen::ColPivHouseholderQR<Monomials> qr(monomials / scale);
  Eigen::Matrix<Real, kTerms, kTerms> work = qr.matrixQR().topRows<kTerms>().triangularView<Eigen::Upper>(), right = qr.colsPermutation();
  Real most = work.diagonal().cwiseAbs().maxCoeff();
  for (bool finished = false; !finished;) {
    finished = true;
    for (int p = 1; p < kTerms; ++p)
      for (int q = 0; q < p; ++q) {
        const Real rounding = std::max(std::numeric_limits<Real>::min(), 2 * std::numeric_limits<Real>::epsilon() * most);
        if (!(std::abs(work(p, q)) > rounding || std::abs(work(q, p)) > rounding)) continue;
        finished = false;
        Eigen::JacobiRotation<Real> onTheLeft, onTheRight;
        Eigen::internal::real_2x2_jacobi_svd(work, p, q, &onTheLeft, &onTheRight);
        work.applyOnTheLeft(p, q, onTheLeft);
        work.applyOnTheRight(p, q, onTheRight);
        right.applyOnTheRight(p, q, onTheRight);
        most = std::max({most, std::abs(work(p, p)), std::abs(work(q, q))});
      }
  }
  Eigen::Matrix<Real, kTerms, 1> sigma = work.diagonal().cwiseAbs() * scale;
  Eigen::Index least = 0;
  sigma.minCoeff(&least);
  std::sort(sigma.begin(), sigma.end());
  if (sigma(0) > kVanishes * sigma(kTerms - 1) || sigma(1) < kUnique * sigma(kTerms - 1)) return std::nullopt;
  return right.col(least).cast<double>();
}

}  // namespace

std::optional<Sphere> sphereOf(const Quadric& quadric) {
  const std::array<double, 6>& a = quadric.a;
  const double most = kRound * std::abs(a[0]);
  if (!(std::abs(a[1] - a[0]) <= most && std::abs(a[2] - a[0]) <= most)) return std::nullopt;
  if (!(std::abs(a[3]) <= most && std::abs(a[4]) <= most && std::abs(a[5]) <= most)) return std::nullopt;
  const Vec3 toMiddle = quadric.b * (-0.5 / a[0]);  // F = a |d - toMiddle|^2 - a R^2
  const double square = dot(toMiddle, toMiddle) - quadric.c / a[0];
  if (!(square > 0)) return std::nullopt;
  return Sphere{quadric.centre + toMiddle, std::sqrt(square)};
}

std::optional<Quadric> fitQuadric(const constraints::Surface& surface, const std::array<constraints::Domain, 2>& domain,
                                  const std::array<double, 2>& start) {
  std::vector<Vec3> points;
  Vec3 centre;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAcross; ++j) {
      // Off the lattice's corners, and unevenly, so that no symmetry of the surface is mistaken for a law.
      const double fu = (i + 0.37 + 0.011 * j) / (kAcross + 0.5), fv = (j + 0.41 + 0.013 * i) / (kAcross + 0.5);
      const Vec3 r = constraints::evaluate(surface, sampleAt(domain[0], start[0], fu), sampleAt(domain[1], start[1], fv)).r;
      if (!isFinite(r)) return std::nullopt;
      points.push_back(r);
      centre += r;
    }
  centre *= 1.0 / static_cast<double>(points.size());
  double size = 0;
  for (const Vec3& r : points) size = std::max(size, norm(r - centre));
  if (!(size > 0)) return std::nullopt;

  Monomials monomials(points.size(), kTerms);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 d = (points[i] - centre) / size;
    monomials.row(static_cast<Eigen::Index>(i)) << d.x * d.x, d.y * d.y, d.z * d.z, d.x * d.y, d.x * d.z, d.y * d.z, d.x, d.y, d.z, 1;
  }
  const auto law = findNullVector(monomials);
  if (!law) return std::nullopt;
  const Eigen::Matrix<double, kTerms, 1>& f = *law;

  Quadric q;
  q.centre = centre;
  q.a = {f(0) / size, f(1) / size, f(2) / size, f(3) / 2 / size, f(4) / 2 / size, f(5) / 2 / size};
  q.b = {f(6), f(7), f(8)};
  q.c = f(9) * size;
  double slope = 0;
  for (const Vec3& r : points) slope += norm(q.gradient(r));
  slope /= static_cast<double>(points.size());
  if (!(slope > 0)) return std::nullopt;
  for (double& value : q.a) value /= slope;
  q.b = q.b / slope;
  q.c /= slope;
  if (hasApex(q)) {
    if (!isCone(q)) return std::nullopt;
    putApexFirst(q, size);
  }
  return q;
}

bool provesQuadric(const constraints::Constraint& surface, const Quadric& q) {
  if (surface.formula == nullptr) return false;
  const double* shape = surface.shape();
  const constraints::ExpressionGraph& graph = surface.formula->graph;
  std::array<constraints::Polynomial, 3> d;
  const double centre[3] = {q.centre.x, q.centre.y, q.centre.z};
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto coordinate = constraints::Polynomial::of(graph, surface.formula->roots[k], shape);
    if (!coordinate) return false;
    d[k] = *coordinate;
    d[k] += constraints::Polynomial::constant(-centre[k]);
    size = std::max(size, d[k].largest());
  }
  constraints::Polynomial f = constraints::Polynomial::constant(q.c);
  const double slope[3] = {q.b.x, q.b.y, q.b.z};
  for (std::size_t k = 0; k < 3; ++k) {
    constraints::Polynomial term = d[k];
    term *= slope[k];
    f += term;
  }
  constexpr std::size_t kRow[6] = {0, 1, 2, 0, 0, 1}, kColumn[6] = {0, 1, 2, 1, 2, 2};
  for (std::size_t k = 0; k < 6; ++k) {
    auto product = d[kRow[k]].times(d[kColumn[k]], graph, shape);
    if (!product) return false;
    *product *= q.a[k] * (k < 3 ? 1 : 2);
    f += *product;
  }
  constexpr double kRounding = 1e-11;  // of a coordinate's largest coefficient: what the fit leaves
  return f.largest() <= kRounding * size;
}

bool hasApex(const Quadric& q) {
  Eigen::Matrix3d a;
  Eigen::Vector3d b;
  const Eigen::Vector3d d = flattest(q, a, b);
  return !((2 * a * d + b).norm() > kNone) && !(std::abs(d.dot(a * d) + b.dot(d) + q.c) > kOn);
}

}  // namespace reachlab::dynamics
