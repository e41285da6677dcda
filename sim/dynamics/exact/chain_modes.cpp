#include "sim/dynamics/exact/chain_modes.h"

#include <cmath>

#include "base/math/matrix.h"
#include "sim/dynamics/exact/oscillator_core.h"

namespace reachlab::dynamics {
namespace {

using Real = long double;
using Vector = std::vector<Real>;

/// Symmetric tridiagonal M^-1/2 K M^-1/2.
struct Tridiagonal {
  Vector diagonal, off;
};

Tridiagonal assemble(const ObjectModel& model, const std::vector<double>& spring, Real hand, Real all) {
  const int n = model.count();
  Tridiagonal t{Vector(n), Vector(n > 1 ? n - 1 : 0)};
  for (int i = 0; i < n; ++i) {
    const Real sum = all + (i == 0 ? hand : 0) + (i > 0 ? Real(spring[i - 1]) : 0) + (i + 1 < n ? Real(spring[i]) : 0);
    t.diagonal[i] = sum / model.mass[i];
    if (i + 1 < n) t.off[i] = -spring[i] / std::sqrt(Real(model.mass[i]) * model.mass[i + 1]);
  }
  return t;
}

Real quotient(const Tridiagonal& t, const Vector& x) {
  Real sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += t.diagonal[i] * x[i] * x[i];
    if (i + 1 < x.size()) sum += 2 * t.off[i] * x[i] * x[i + 1];
  }
  return sum;
}

void normalise(Vector& x) {
  Real sum = 0;
  for (const Real value : x) sum += value * value;
  for (Real& value : x) value /= std::sqrt(sum);
}

/// Solves (T - shift) y = x by elimination with row exchanges; a vanishing pivot is replaced by a tiny one, as inverse iteration wants.
Vector solveShifted(const Tridiagonal& t, Real shift, Vector x, Real tiny) {
  const int n = static_cast<int>(x.size());
  Vector a(n), b(n), c(n);  // rows of the upper factor: diagonal, first and second above
  Vector d = t.diagonal, up(n), low(n);
  for (int i = 0; i < n; ++i) d[i] -= shift;
  for (int i = 0; i + 1 < n; ++i) up[i] = low[i] = t.off[i];
  Real p = d[0], q = n > 1 ? up[0] : 0, s = 0;
  for (int i = 0; i + 1 < n; ++i) {
    Real p2 = low[i], q2 = d[i + 1], s2 = i + 2 < n ? up[i + 1] : 0;
    if (std::abs(p2) > std::abs(p)) {
      std::swap(p, p2);
      std::swap(q, q2);
      std::swap(s, s2);
      std::swap(x[i], x[i + 1]);
    }
    if (p == 0) p = tiny;
    a[i] = p, b[i] = q, c[i] = s;
    const Real factor = p2 / p;
    p = q2 - factor * q;
    q = s2 - factor * s;
    s = 0;
    x[i + 1] -= factor * x[i];
  }
  a[n - 1] = p == 0 ? tiny : p;
  for (int i = n - 1; i >= 0; --i) {
    Real rest = x[i];
    if (i + 1 < n) rest -= b[i] * x[i + 1];
    if (i + 2 < n) rest -= c[i] * x[i + 2];
    x[i] = rest / a[i];
  }
  return x;
}

}  // namespace

ChainModes computeModes(const ObjectModel& model, bool coupled) {
  const int n = model.count();
  const Tridiagonal stiffness = assemble(model, model.stiffness, coupled ? model.handStiffness[0] : 0, 0);
  const Tridiagonal damping = assemble(model, model.damping, coupled ? model.handDamping[0] : 0, model.viscosity);
  Eigen::VectorXd diagonal(n), off(n > 1 ? n - 1 : 0);
  for (int i = 0; i < n; ++i) diagonal[i] = static_cast<double>(stiffness.diagonal[i]);
  for (int i = 0; i + 1 < n; ++i) off[i] = static_cast<double>(stiffness.off[i]);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, off);
  const double largest = solver.eigenvalues().cwiseAbs().maxCoeff();

  ChainModes modes;
  modes.toMasses.resize(n, n);
  modes.toModes.resize(n, n);
  double rate = 0;
  for (int i = 0; i < n; ++i) rate = std::max(rate, static_cast<double>(damping.diagonal[i]));
  for (int j = 0; j < n; ++j) {
    Vector x(n);
    for (int i = 0; i < n; ++i) x[i] = solver.eigenvectors()(i, j);
    for (int round = 0; round < 2; ++round) {
      x = solveShifted(stiffness, quotient(stiffness, x), x, Real(1e-19) * std::max(largest, 1e-300));
      normalise(x);
    }
    modes.squaredFrequency.push_back(static_cast<double>(std::max(Real(0), quotient(stiffness, x))));
    const Real c = quotient(damping, x);
    modes.damping.push_back(static_cast<double>(c));
    for (int i = 0; i < n; ++i) {
      const Real residual =
          damping.diagonal[i] * x[i] + (i > 0 ? damping.off[i - 1] * x[i - 1] : 0) + (i + 1 < n ? damping.off[i] * x[i + 1] : 0) - c * x[i];
      if (std::abs(residual) > Real(1e-13) * rate) modes.proportional = false;
      const Real root = std::sqrt(Real(model.mass[i]));
      modes.toMasses(i, j) = static_cast<double>(x[i] / root);
      modes.toModes(j, i) = static_cast<double>(x[i] * root);
    }
  }
  return modes;
}

bool canBeModal(const ObjectModel& model) {
  if (model.kind == experiment::ObjectKind::Parallel) return true;
  return computeModes(model, true).proportional && computeModes(model, false).proportional;
}

}  // namespace reachlab::dynamics
