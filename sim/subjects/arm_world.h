#pragma once

#include "base/math/matrix.h"
#include "sim/predict/line/line_object.h"

namespace reachlab::subjects {

/// A hand with mass and muscle that holds an object, along one line: x' = A x + b u with x = [h, h', f, g, x_1 … x_N, v_1 … v_N]. Positions
/// are metres from the target. f [N] is the muscle's force, g [N] is its first stage, and u [N] is the command.
///   m h'' = f - d h' - F      tau f' = g - f      tau g' = u - g      F = c x the object's force on the hand
struct ArmWorld {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  Eigen::RowVectorXd contact;   // c
  Eigen::RowVectorXd netForce;  // mass times acceleration [N], summed over hand and object
  int masses = 0;
  int states() const { return 4 + 2 * masses; }
  int place(int mass) const { return 4 + mass; }
  int speed(int mass) const { return 4 + masses + mass; }
};

struct ArmSpec {
  double mass = 1.5;     // [kg]
  double damping = 10;   // [N s/m]
  double muscle = 0.04;  // [s] of each stage
};

/// The subject's errors about the object: all springs are off by one factor, and all masses by another factor.
struct ModelError {
  double stiffness = 0, mass = 0;  // ln of assumed over true value
};

ArmWorld makeArmWorld(const ArmSpec& arm, predict::LineObject object, const ModelError& error = {});

/// x(t + dt) = A x + b u with constant u.
struct SteppedWorld {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
};
SteppedWorld stepWorld(const ArmWorld& world, double dt);

/// The arm alone over dt, with constant command and constant force of the object: [h, h', f, g] -> A [h, h', f, g] + u bCommand + F bForce.
/// F acts on the hand.
struct SteppedArm {
  Eigen::Matrix4d a;
  Eigen::Vector4d command, force;
};
SteppedArm stepArm(const ArmSpec& arm, double dt);

}  // namespace reachlab::subjects
