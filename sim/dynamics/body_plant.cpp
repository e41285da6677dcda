#include "sim/dynamics/systems/body_system.h"

#include "base/error.h"
#include "sim/dynamics/compile.h"
#include "sim/dynamics/make_plant.h"

namespace reachlab::dynamics {
namespace {

/// Adds what a body has beyond a point: orientation, the force at the FP, energy of rotation.
class BodyPlant : public SystemPlant<BodySystem> {
 public:
  using SystemPlant::SystemPlant;

  Vec3 couplingForce(const HandSample& hand) const noexcept override { return system_.handForce(pose(), hand); }
  double energy(const HandSample& hand) const noexcept override {
    const auto p = pose();
    const Vec3 stretch = hand.position - p.r - p.toWorld(system_.fpOffset);
    return 0.5 * model_.mass[0] * dot(p.v, p.v) - model_.mass[0] * dot(model_.gravity, p.r) +
           0.5 * dot(p.turn, experiment::times(system_.inertia, p.turn)) + 0.5 * system_.springs.handStiffness[0] * dot(stretch, stretch);
  }
  void setAngularVelocity(const Vec3& velocity) noexcept override {
    const Vec3 turn = pose().toBody(velocity);
    now()[10] = turn.x, now()[11] = turn.y, now()[12] = turn.z;
    restart();
  }
  BodyState body() const noexcept override { return pose().state(); }

 private:
  BodySystem::Pose pose() const noexcept { return BodySystem::pose(now()); }
};

}  // namespace

BodySystem::BodySystem(const ObjectModel& model, const experiment::Object& object)
    : SpaceSystem(model), inertia(object.inertia), fpOffset(object.fpOffset) {
  const experiment::SquareMatrix<3>& m = inertia;
  const auto minor = [&](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  const double size = m[0][0] + m[1][1] + m[2][2];
  bool symmetric = true;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) symmetric = symmetric && std::abs(m[i][j] - m[j][i]) <= 1e-12 * size;
  if (!symmetric || !(m[0][0] > 0) || !(minor(2, 2) > 0) || !(determinant > 1e-12 * size * size * size / 27))
    throw RefusedError("inertia_kg_m2 must be symmetric and positive definite, or the body has no equation of rotation");
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverseInertia[i][j] = minor(j, i) / determinant;
}

std::unique_ptr<Plant> makeBodyPlant(const ObjectModel& model, const experiment::Object& object, const MethodRequest& request) {
  return makePlant<BodyPlant>(model, BodySystem(model, object), request);
}

}  // namespace reachlab::dynamics
