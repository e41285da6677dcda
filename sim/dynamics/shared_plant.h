#pragma once
#include <memory>
#include <span>

#include "constraints/constraint_spec.h"
#include "sim/dynamics/object/hand_springs.h"
#include "sim/dynamics/object/object_model.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// An object that several hands hold, each by springs of its own (Eq. 8), on a line or smooth curve (coordinates phi of each mass) or free
/// (x, y, z of each mass; a body: x, y, z, and its orientation). Classic RK4, one step a tick. What a Plant says of the hand it says of hand
/// 0; the others follow what `setHand` told last, and rest at the object's start before that.
/// Beside the hands an acceleration of every coordinate can be added, constant over a step: what keeps copies of one object together.
class SharedPlant : public Plant {
 public:
  virtual int handCount() const noexcept = 0;
  /// Hand 1 on: where it goes in the next step, and where it is then. `grip` scales its springs and dampers, 1 held to 0 let go.
  virtual void setHand(int hand, const HandSegment& segment, const HandSample& end, double grip = 1) noexcept = 0;
  /// Of any hand, as it was told or stepped last: force on the object [N], and the place where it holds it (the stiffness-weighted mean of
  /// the masses' where it holds several) [m].
  virtual Vec3 couplingForceOf(int hand) const noexcept = 0;
  virtual Vec3 fixedPoint(int hand) const noexcept = 0;
  /// [J] done by the hand on the object since it was placed: the trapezium rule over every step.
  virtual double work(int hand) const noexcept = 0;

  /// Numbers of `places` and of `rates`: they differ for a body only, whose orientation is four numbers with three rates.
  virtual int placeCount() const noexcept = 0;
  virtual int rateCount() const noexcept = 0;
  virtual std::span<const double> places() const noexcept = 0;  // generalised coordinates; a body's quaternion w x y z at the end
  virtual std::span<const double> rates() const noexcept = 0;   // [1/s]; a body's angular velocity in body axes at the end
  /// The object as such lists have it: for a picture of another's copy. The hands stay as they are.
  virtual void show(std::span<const double> places, std::span<const double> rates) noexcept = 0;
  /// Added to the rates' derivatives in the steps to come. Length rateCount().
  virtual void setExtraAcceleration(std::span<const double> acceleration) noexcept = 0;
  /// What would take this object to `places`, as a vector of rateCount(): the difference of coordinates, a rotation vector in body axes.
  virtual void difference(std::span<const double> places, std::span<double> out) const noexcept = 0;

  /// Root of the mean square, over the masses, of how far they lie apart in two such lists of places [m].
  virtual double distanceBetween(std::span<const double> a, std::span<const double> b) const noexcept = 0;

  /// Kinetic, elastic and gravity energy of the object alone, without the hands' springs; gravity counted from the start [J].
  virtual double objectEnergy() const noexcept = 0;
  virtual double kineticEnergy() const noexcept = 0;
};

/// `constraint`: free, or a curve that is smooth throughout. Throws RefusedError.
std::unique_ptr<SharedPlant> makeSharedPlant(const experiment::Experiment& experiment, const constraints::Constraint& constraint);

}  // namespace reachlab::dynamics
