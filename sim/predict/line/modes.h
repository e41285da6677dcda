#pragma once

#include "base/math/matrix.h"
#include "sim/predict/line/line_object.h"

namespace reachlab::predict {

/// Undamped modes of an object on a line, M-orthonormal: node = Z + sum_j shape(node, j) q_j with
/// q_j'' + frequency_j^2 q_j = -drive_j Z''.
/// Clamped: Z is the hand, nodes are the masses. Free: Z is the centre of mass, nodes are the masses, before them the hand when
/// it has mass (docs/theory/criteria.md, "The object on a line").
struct Modes {
  Eigen::VectorXd frequency;  // [rad/s] ascending, rigid mode left out
  Eigen::MatrixXd shape;      // [1/sqrt(kg)]
  Eigen::VectorXd drive;      // [sqrt(kg)]
};

Modes computeClampedModes(const LineObject& object);
Modes computeFreeModes(const LineObject& object);

}  // namespace reachlab::predict
