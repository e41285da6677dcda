#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sim/experiment/environment.h"
#include "sim/experiment/experiment.h"

namespace reachlab::environment {

/// The inputs of the forces in one tick.
struct HandTick {
  bool engaged = false;  // armed or moving
  bool moving = false;
  Vec3 position;  // [m]
  Vec3 velocity;  // [m/s]
};

/// The experiment's forces on the hand, tick by tick: a pure function of construction and of the ticks since `reset`. A force that would
/// begin with a step grows over kRampTicks. Haptic thread: neither `reset` nor `step` allocates, locks, waits or throws.
class ForceField {
 public:
  static constexpr int kRampTicks = 20;

  /// `start` and `target` of the task [m].
  ForceField(const experiment::Environment& environment, const experiment::Arm& arm, const Vec3& start, const Vec3& target);

  /// Before a trial.
  void reset() noexcept;
  /// The force [N] on the hand. Not finite where a joint field's arm does not reach the hand or is stretched.
  Vec3 step(const HandTick& hand) noexcept;
  /// The hand was further from the line than a channel allows, in this trial.
  bool channelBroken() const noexcept { return channelBroken_; }

 private:
  struct Running {
    experiment::HandForce force;
    std::int64_t age = -1;       // [ticks] since it began; -1: it has not
    std::int64_t letGoAge = -1;  // [ticks] since a channel let go
    std::int64_t moved = -1;     // [ticks] since movement onset, of a pulse
  };

  Vec3 exert(Running& running, const HandTick& hand) noexcept;
  Vec3 channel(const experiment::ChannelForce& law, Running& running, const HandTick& hand) noexcept;
  Vec3 pulse(const experiment::PulseForce& law, Running& running, const HandTick& hand) noexcept;

  std::vector<Running> forces_;
  experiment::Arm arm_;
  Vec3 start_, along_;  // [m], and the direction from start to target
  bool channelBroken_ = false;
};

/// The part of `v` at right angles to `along`, which has length 1.
Vec3 across(const Vec3& v, const Vec3& along) noexcept;

/// Shoulder and elbow angle [rad] of an arm whose hand is at (right, forward) [m] from the shoulder. Both are counted from the right, so
/// the elbow's angle is absolute. Not finite out of reach.
std::array<double, 2> absoluteAngles(const experiment::Arm& arm, double right, double forward) noexcept;
/// The hand's rate (right, forward) by the rates of the absolute angles [m/rad].
experiment::SquareMatrix<2> absoluteJacobian(const experiment::Arm& arm, const std::array<double, 2>& angles) noexcept;

}  // namespace reachlab::environment
