#include <cmath>

#include "base/fault.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/protocol.h"

namespace reachlab::trial {
namespace {

constexpr double kWholeTick = 1e-6;  // [ticks] a decimal time such as 1.35 s is a whole number of ticks, whatever its binary form

}  // namespace

ProtocolSettings makeProtocolSettings(const experiment::Experiment& experiment, const constraints::Constraint& constraint) {
  const experiment::Task& task = experiment::requiredTask(experiment);
  ProtocolSettings s;
  s.start = constraints::placeOn(constraint, task.start);
  s.target = constraints::placeOn(constraint, task.target);
  if (!isFinite(s.start)) throw FaultError(Fault{"task.start", "is no place on the constraint", "where the formula has a value"});
  if (!isFinite(s.target)) throw FaultError(Fault{"task.target", "is no place on the constraint", "where the formula has a value"});
  s.via = task.via;
  s.viaRadius = task.viaRadius;
  s.armRadius = task.armRadius;
  s.onset = task.onset;
  s.restTicks = std::llround(task.rest.seconds * kTicksPerSecond);
  s.restSpeed = task.rest.speed;
  s.positionTolerance = task.tolerance.position;
  s.velocityTolerance = task.tolerance.velocity;
  s.comesBack =
      constraint.kind != constraints::ConstraintKind::Free && !constraint.straight && norm(s.target - s.start) <= s.positionTolerance;
  s.earliest = task.duration - task.tolerance.time;
  s.earliestTick = std::llround(std::ceil(s.earliest * kTicksPerSecond - kWholeTick));
  s.latestTick = std::llround(std::floor((task.duration + task.tolerance.time) * kTicksPerSecond + kWholeTick));
  s.timeoutTicks = std::llround(task.timeout * kTicksPerSecond);
  s.maxMissedTicks = experiment.timing.maxMissedTicks;
  s.maxGapTicks = std::llround(std::floor(experiment.timing.maxGap * kTicksPerSecond + kWholeTick));
  s.forceLimitEndsTrial = experiment.forceLimitEndsTrial;
  return s;
}

}  // namespace reachlab::trial
