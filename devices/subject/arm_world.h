#pragma once

#include "base/math/matrix.h"
#include "sim/predict/line/line_object.h"

namespace reachlab::devices {

/// A hand with mass and muscle that holds an object, along one way: x' = A x + b u with x = [h, h', f, g, x_1 … x_N, v_1 … v_N]; positions
/// are metres from the target, f [N] the muscle's force, g [N] its first stage, u [N] the command.
///   m h'' = f - d h' - F      tau f' = g - f      tau g' = u - g      F = c x the object's force on the hand
struct ArmWorld {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  Eigen::RowVectorXd contact;  // c
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

/// What a subject takes the object for: all springs and all masses off by a factor each.
struct ModelError {
  double stiffness = 0, mass = 0;  // ln of assumed over true
};

ArmWorld makeArmWorld(const ArmSpec& arm, predict::LineObject object, const ModelError& error = {});

/// x(t + dt) = A x + b u with u held.
struct SteppedWorld {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
};
SteppedWorld stepWorld(const ArmWorld& world, double dt);

/// The arm alone over dt, command and object's force held: [h, h', f, g] -> A [h, h', f, g] + u bCommand + F bForce, F on the hand.
struct SteppedArm {
  Eigen::Matrix4d a;
  Eigen::Vector4d command, force;
};
SteppedArm stepArm(const ArmSpec& arm, double dt);

}  // namespace reachlab::devices
