#pragma once
#include <memory>
#include <span>

#include "constraints/constraint_spec.h"
#include "sim/dynamics/object/hand_springs.h"
#include "sim/dynamics/object/object_model.h"
#include "sim/dynamics/object/plant.h"

namespace reachlab::dynamics {

/// An object that several hands hold, each by separate springs (Eq. 8). It lies on a line or smooth curve (coordinates phi of each mass),
/// or is free. A free object has x, y, z of each mass. A free body has x, y, z and its orientation. The method is classic RK4, one step per
/// tick. Members of Plant that concern the hand concern hand 0. The other hands follow the last call of `setHand`. Before that call they
/// rest at the start of the object. A constant acceleration of every coordinate can be added over a step. It keeps copies of one object
/// together.
class SharedPlant : public Plant {
 public:
  virtual int handCount() const noexcept = 0;
  /// For hands 1 and up: the motion in the next step, and the sample at its end. `grip` scales the springs and dampers from 1 (held) to 0
  /// (let go).
  virtual void setHand(int hand, const HandSegment& segment, const HandSample& end, double grip = 1) noexcept = 0;
  /// For any hand, after the last step or setHand: its force on the object [N], and the point at which it holds the object [m]. If the hand
  /// holds several masses, the point is their stiffness-weighted mean.
  virtual Vec3 couplingForceOf(int hand) const noexcept = 0;
  virtual Vec3 fixedPoint(int hand) const noexcept = 0;
  /// Work [J] of the hand on the object since it was placed, by the trapezium rule over every step.
  virtual double work(int hand) const noexcept = 0;

  /// The lengths of `places` and of `rates`. They differ only for a body, whose orientation has four numbers and three rates.
  virtual int placeCount() const noexcept = 0;
  virtual int rateCount() const noexcept = 0;
  virtual std::span<const double> places() const noexcept = 0;  // generalised coordinates; a body's quaternion w x y z at the end
  virtual std::span<const double> rates() const noexcept = 0;   // [1/s]; a body's angular velocity in body axes at the end
  /// Shows the object in the state of such lists, as the picture of a copy elsewhere. The hands keep their state.
  virtual void show(std::span<const double> places, std::span<const double> rates) noexcept = 0;
  /// Sets an acceleration that the next steps add to the derivatives of the rates. Length rateCount().
  virtual void setExtraAcceleration(std::span<const double> acceleration) noexcept = 0;
  /// The displacement from this object to `places`, as a vector of rateCount(). It is the difference of coordinates, and for a body a
  /// rotation vector in body axes.
  virtual void difference(std::span<const double> places, std::span<double> out) const noexcept = 0;

  /// Root mean square, over the masses, of their distances in two such lists of places [m].
  virtual double distanceBetween(std::span<const double> a, std::span<const double> b) const noexcept = 0;

  /// Kinetic, elastic and gravity energy [J] of the object alone, without the springs of the hands. Gravity counts from the start.
  virtual double objectEnergy() const noexcept = 0;
  virtual double kineticEnergy() const noexcept = 0;
};

/// `constraint`: free, or a curve that is smooth throughout. Throws RefusedError.
std::unique_ptr<SharedPlant> makeSharedPlant(const experiment::Experiment& experiment, const constraints::Constraint& constraint);

}  // namespace reachlab::dynamics
