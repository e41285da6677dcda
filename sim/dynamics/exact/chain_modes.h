#pragma once
#include <vector>

#include "base/math/matrix.h"
#include "sim/dynamics/object/object_model.h"

namespace reachlab::dynamics {

/// Modes of a chain: x = toMasses e, e = toModes x, with toMasses^T M toMasses = 1. For a force f on mass 1, e_j'' + damping_j e_j' +
/// squaredFrequency_j e_j = toMasses(0, j) f.
struct ChainModes {
  std::vector<double> squaredFrequency;  // [1/s^2]
  std::vector<double> damping;           // [1/s], meaningful if `proportional`
  bool proportional = true;              // the modes diagonalise the damping to rounding
  Eigen::MatrixXd toMasses, toModes;
};

/// Eigenvalues and vectors in doubles, then one inverse iteration for each mode in 64 bits on the tridiagonal matrix. Slow modes keep their
/// digits beside fast modes.
ChainModes computeModes(const ObjectModel& model, bool coupled);

}  // namespace reachlab::dynamics
