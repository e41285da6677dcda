#pragma once
#include <functional>
#include <optional>

#include "base/math/vec3.h"
#include "sim/predict/predict.h"

namespace reachlab::devices {

/// Where a subject means to have the hand: a function of time on [0, duration] [m], world frame. Not to be asked after the experiment that it
/// was made for is gone: the constraint's formula is the experiment's.
struct ReachPlan {
  double duration = 0;  // [s]
  std::function<Vec3(double time)> handAt;
};

/// The reach from start to target of this task, planned for this very object:
///   - on a straight line, and free in space along the chord: what the criterion predicts (nullopt: minimum hand jerk);
///   - on a curve: what the criterion predicts there, along the arc; of one mass the mass is to follow it, so the hand leads it by the
///     coupling's extension, r_HIP = r + d, k d + b d' = m r'' + lambda r'. Where that is refused and no criterion was asked for: chain or
///     parallel masses by the prediction for a line as long as the curve, beyond whose ends the curve goes on; one mass as on a surface;
///   - one mass on a surface: the mass is to follow the minimum-jerk law in the constraint's parameters.
/// The movement takes the task's T, unless it would then be judged too short even if carried out to the letter (the parallel object
/// creeps into a wide tolerance long before T): a subject who has practised takes longer, so that it is judged to take T.
/// Gravity is not compensated, and a body is taken for a point: held ahead of its centre on the line of the reach it follows, held more
/// than some millimetres beside that line it swings and does not come to rest. Throws FaultError (no task, start and target are one
/// place, a criterion or a hand mass where no criterion is followed), RefusedError from predict.
ReachPlan makeReachPlan(const experiment::CompiledExperiment& experiment, std::optional<predict::Criterion> criterion,
                        std::optional<double> handMass);

}  // namespace reachlab::devices
