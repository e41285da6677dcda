#include "sim/subjects/arm_world.h"

#include <cmath>

#include "base/math/eigen_solvers.h"
#include "base/math/elementary.h"

namespace reachlab::subjects {

ArmWorld makeArmWorld(const ArmSpec& arm, predict::LineObject object, const ModelError& error) {
  for (double& k : object.springs) k *= elementary::exp(error.stiffness);
  for (double& m : object.masses) m *= elementary::exp(error.mass);
  ArmWorld world;
  world.masses = object.count();
  const int n = world.states();
  world.a = Eigen::MatrixXd::Zero(n, n);
  world.b = Eigen::VectorXd::Zero(n);
  world.contact = Eigen::RowVectorXd::Zero(n);
  for (int i = 0; i < world.masses; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool toHand = object.parallel || i == 0;
    // Force of this spring and damper on mass i, and back on what it hangs on.
    Eigen::RowVectorXd force = Eigen::RowVectorXd::Zero(n);
    force(toHand ? 0 : world.place(i - 1)) += object.springs[at];
    force(world.place(i)) -= object.springs[at];
    force(toHand ? 1 : world.speed(i - 1)) += object.dampers[at];
    force(world.speed(i)) -= object.dampers[at];
    world.a(world.place(i), world.speed(i)) = 1;
    world.a.row(world.speed(i)) += force / object.masses[at];
    world.a(world.speed(i), world.speed(i)) -= object.viscosity[at] / object.masses[at];
    if (toHand) world.contact += force;
    else world.a.row(world.speed(i - 1)) -= force / object.masses[at - 1];
  }
  world.a(0, 1) = 1;
  world.a.row(1) = -world.contact / arm.mass;
  world.a(1, 1) -= arm.damping / arm.mass;
  world.a(1, 2) += 1 / arm.mass;
  world.netForce = arm.mass * world.a.row(1);
  for (int i = 0; i < world.masses; ++i) world.netForce += object.masses[static_cast<std::size_t>(i)] * world.a.row(world.speed(i));
  world.a(2, 2) = -1 / arm.muscle;
  world.a(2, 3) = 1 / arm.muscle;
  world.a(3, 3) = -1 / arm.muscle;
  world.b(3) = 1 / arm.muscle;
  return world;
}

SteppedWorld stepWorld(const ArmWorld& world, double dt) {
  const Eigen::MatrixXd step = heldStep(world.a, world.b, dt);
  return {step.leftCols(world.states()), step.col(world.states())};
}

SteppedArm stepArm(const ArmSpec& arm, double dt) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4, 4), b = Eigen::MatrixXd::Zero(4, 2);
  a(0, 1) = 1;
  a(1, 1) = -arm.damping / arm.mass;
  a(1, 2) = 1 / arm.mass;
  a(2, 2) = -1 / arm.muscle;
  a(2, 3) = 1 / arm.muscle;
  a(3, 3) = -1 / arm.muscle;
  b(3, 0) = 1 / arm.muscle;
  b(1, 1) = 1 / arm.mass;
  const Eigen::MatrixXd step = heldStep(a, b, dt);
  return {step.leftCols(4), step.col(4), step.col(5)};
}

}  // namespace reachlab::subjects
