#include "sim/predict/line/modes.h"

#include <cmath>

#include "base/math/eigen_solvers.h"

namespace reachlab::predict {
namespace {

// One spring of the network: elongation = x[to] - x[from]; `from` -1 is a clamped hand.
struct Spring {
  int from, to;
  double stiffness;
};

// All modes but the first `rigid`. Frequencies are Rayleigh quotients, summed over the springs' energies: every term is positive, so that a
// low frequency keeps its relative precision beside high ones.
template <class Energy>
Modes computeModes(const Eigen::VectorXd& masses, const Eigen::MatrixXd& stiffness, Eigen::Index rigid, const Energy& twiceEnergyOf) {
  const Eigen::VectorXd scale = masses.cwiseSqrt().cwiseInverse();
  const SymmetricEigen solved = solveSymmetric(scale.asDiagonal() * stiffness * scale.asDiagonal());
  Modes modes;
  modes.shape = scale.asDiagonal() * solved.vectors.rightCols(masses.size() - rigid);
  modes.frequency.resize(modes.shape.cols());
  for (Eigen::Index j = 0; j < modes.shape.cols(); ++j) modes.frequency(j) = std::sqrt(twiceEnergyOf(modes.shape.col(j)));
  return modes;
}

// Of masses joined by springs.
Modes computeNetworkModes(const Eigen::VectorXd& masses, const std::vector<Spring>& springs, bool dropRigid) {
  const Eigen::Index n = masses.size();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (const Spring& s : springs) {
    k(s.to, s.to) += s.stiffness;
    if (s.from < 0) continue;
    k(s.from, s.from) += s.stiffness;
    k(s.from, s.to) -= s.stiffness;
    k(s.to, s.from) -= s.stiffness;
  }
  return computeModes(masses, k, dropRigid ? 1 : 0, [&](const auto& shape) {
    double energy = 0;
    for (const Spring& s : springs) {
      const double e = shape(s.to) - (s.from < 0 ? 0.0 : shape(s.from));
      energy += s.stiffness * e * e;
    }
    return energy;
  });
}

std::vector<Spring> springsOf(const LineObject& object, int hand) {
  std::vector<Spring> springs;
  for (int i = 0; i < object.count(); ++i)
    springs.push_back({i == 0 || object.parallel ? hand : hand + i, hand + 1 + i, object.springs[i]});
  return springs;
}

Eigen::VectorXd massesOf(const LineObject& object) { return Eigen::Map<const Eigen::VectorXd>(object.masses.data(), object.count()); }

// Massless hand between parallel springs: the hub follows the masses, h = sum k_i x_i / sum k, and each spring pulls towards it.
Modes computeHubModes(const LineObject& object) {
  const Eigen::VectorXd masses = massesOf(object);
  const Eigen::VectorXd k = Eigen::Map<const Eigen::VectorXd>(object.springs.data(), object.count());
  const Eigen::VectorXd share = k / k.sum();
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(k.asDiagonal()) - k * share.transpose();
  Modes modes = computeModes(masses, stiffness, 1, [&](const auto& shape) {
    const Eigen::ArrayXd elongation = shape.array() - share.dot(shape);
    return (k.array() * elongation.square()).sum();
  });
  modes.drive = -masses.sum() * (modes.shape.transpose() * share);
  return modes;
}

}  // namespace

Modes computeClampedModes(const LineObject& object) {
  Modes modes = computeNetworkModes(massesOf(object), springsOf(object, -1), false);
  modes.drive = modes.shape.transpose() * massesOf(object);
  return modes;
}

Modes computeFreeModes(const LineObject& object) {
  if (object.handMass > 0) {
    Eigen::VectorXd masses(object.count() + 1);
    masses << object.handMass, massesOf(object);
    Modes modes = computeNetworkModes(masses, springsOf(object, 0), true);
    modes.drive = -masses.sum() * modes.shape.row(0).transpose();
    return modes;
  }
  if (object.parallel) return computeHubModes(object);
  std::vector<Spring> springs = springsOf(object, -1);
  springs.erase(springs.begin());
  Modes modes = computeNetworkModes(massesOf(object), springs, true);
  modes.drive = -object.totalMass() * modes.shape.row(0).transpose();
  return modes;
}

}  // namespace reachlab::predict
