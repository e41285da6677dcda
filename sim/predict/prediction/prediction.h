#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/predict/prediction/criterion.h"

namespace reachlab::predict {

/// The role of an object `point`: a mass behind the coupling's spring, or the hand itself (a single mass together with it). On a line the
/// default is BehindSpring, and on curves and surfaces it is Hand (docs/predictions.md says why). An option can change it.
enum class PointIs { BehindSpring, Hand };
std::string_view nameOf(PointIs point);  // "behind-spring", "hand"

/// One instant of a predicted movement: metres along the line (or of arc length along a curve) from the start.
struct PredictedHand {
  double position = 0, velocity = 0, acceleration = 0;  // [m], [m/s], [m/s^2]
};

/// The predicted movement of the hand for one experiment under one criterion. Profiles are functions of time on [0, T], with inner limits
/// at 0 and T: end jumps and pulses are numbers here, never samples. Immutable after predict(). Any thread. The functions `…At` never
/// allocate, but the haptic thread must not call them: sample the prediction beforehand.
class Prediction {
 public:
  virtual ~Prediction() = default;
  virtual PredictedHand handAt(double t) const = 0;
  /// Positions and velocities of all masses at t, in spans of massCount().
  virtual void massesAt(double t, std::span<double> position, std::span<double> velocity) const = 0;
  /// Velocity of the last mass [m/s].
  virtual double objectVelocityAt(double t) const;
  /// Velocities of hand and last mass at equally spaced times from 0 to T. Both spans have the same size, two or more.
  virtual void sampleVelocities(std::span<double> hand, std::span<double> object) const;
  int massCount() const { return massCount_; }
  /// Equal parts of [0, T] that are fine enough to see every wave of the profiles.
  int scanCount() const { return 48 + static_cast<int>(1.2 * fastest_ * duration); }

  Criterion criterion{};
  double duration = 0;                    // [s]
  double distance = 0;                    // [m]
  double cost = 0;                        // integral of u^2, no 1/2
  double condition = 0;                   // of the linear solve
  std::optional<double> profileError;     // estimated, of the hand's peak; nullopt: right to rounding times the condition
  std::optional<double> travelTime;       // [s] T*, chain only
  double handPeak = 0, handPeakTime = 0;  // [m/s], [s] largest |v| on [0+, T-], signed, earliest if equal
  double objectPeak = 0;                  // [m/s] last mass
  std::optional<double> handJump = 0, handVelocityJump = 0;  // [m], [m/s] at t = 0+; nullopt where a pulse makes it meaningless
  std::optional<PointIs> point;                              // nullopt: the object is no point
  std::vector<std::string> warnings;                         // T < T*, condition, merged frequencies …
  std::vector<double> unknowns;                              // of an iteration, in its own basis; empty where there was none

 protected:
  int massCount_ = 0;
  double fastest_ = 0;  // [rad/s] highest frequency in the profiles
};

}  // namespace reachlab::predict
