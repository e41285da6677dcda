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

// Modes of masses joined by springs. Frequencies are Rayleigh quotients summed over spring energies: every term is positive, so a
// low frequency keeps its relative precision beside high ones.
Modes computeNetworkModes(const Eigen::VectorXd& masses, const std::vector<Spring>& springs, bool dropRigid) {
  const Eigen::Index n = masses.size();
  const Eigen::VectorXd scale = masses.cwiseSqrt().cwiseInverse();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  for (const Spring& s : springs) {
    k(s.to, s.to) += s.stiffness;
    if (s.from < 0) continue;
    k(s.from, s.from) += s.stiffness;
    k(s.from, s.to) -= s.stiffness;
    k(s.to, s.from) -= s.stiffness;
  }
  const SymmetricEigen solved = solveSymmetric(scale.asDiagonal() * k * scale.asDiagonal());
  const Eigen::Index first = dropRigid ? 1 : 0;
  Modes modes;
  modes.shape = scale.asDiagonal() * solved.vectors.rightCols(n - first);
  modes.frequency.resize(n - first);
  for (Eigen::Index j = 0; j < n - first; ++j) {
    double energy = 0;
    for (const Spring& s : springs) {
      const double e = modes.shape(s.to, j) - (s.from < 0 ? 0.0 : modes.shape(s.from, j));
      energy += s.stiffness * e * e;
    }
    modes.frequency(j) = std::sqrt(energy);
  }
  return modes;
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
  const Eigen::VectorXd scale = masses.cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd share = k / k.sum();
  const Eigen::MatrixXd stiffness = Eigen::MatrixXd(k.asDiagonal()) - k * share.transpose();
  const SymmetricEigen solved = solveSymmetric(scale.asDiagonal() * stiffness * scale.asDiagonal());
  Modes modes;
  modes.shape = scale.asDiagonal() * solved.vectors.rightCols(masses.size() - 1);
  modes.frequency.resize(modes.shape.cols());
  for (Eigen::Index j = 0; j < modes.shape.cols(); ++j) {
    const Eigen::ArrayXd elongation = modes.shape.col(j).array() - share.dot(modes.shape.col(j));
    modes.frequency(j) = std::sqrt((k.array() * elongation.square()).sum());
  }
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
