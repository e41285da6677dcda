#pragma once
#include <functional>
#include <optional>

#include "base/math/vec3.h"
#include "sim/experiment/experiment.h"
#include "sim/predict/predict.h"

namespace reachlab::subjects {

/// The intended position of the hand: a function of time on [0, duration] [m], world frame. Do not call it after its experiment is gone,
/// because the constraint's formula belongs to the experiment.
struct ReachPlan {
  double duration = 0;  // [s]
  std::function<Vec3(double time)> handAt;
};

/// The same object on the straight line of the catalogue, for which the criteria are defined, for a way of this length [m]. A way that no
/// line has is taken on the nearest line, since the reaches of an object on springs scale with the distance.
struct LineExperiment {
  experiment::Experiment experiment;
  double length = 0, scale = 1;  // [m] of the line; of the way, in lines
};
LineExperiment onLine(const experiment::Experiment& experiment, double length);

/// The reach from start to target of this task, planned for this very object:
///   - on a straight line, and free in space along the chord: the prediction of the criterion (nullopt: minimum hand jerk);
///   - on a curve: the prediction of the criterion there, along the arc; one mass is to follow it, so the hand leads it by the
///   coupling's extension, r_HIP = r + d, k d + b d' = m r'' + lambda r'. Where that is refused and no criterion was asked for: chain or
///   parallel masses by the prediction for a line as long as the curve, which is continued beyond its ends; one mass as on a surface;
///   - one mass on a surface: the mass is to follow the minimum-jerk law in the constraint's parameters.
/// The movement takes the task's T. If even a perfect movement would then be judged too short, it takes longer, so that it is judged to
/// take T. The parallel object, for example, creeps into a wide tolerance long before T. Gravity is not compensated. A body is taken for a
/// point. Held ahead of its centre on the line of the reach, it follows. Held more than some millimetres beside that line, it swings and
/// does not come to rest. Throws FaultError: no task, start and target at one position, or a criterion or hand mass where no criterion is
/// followed. Throws RefusedError from predict.
ReachPlan makeReachPlan(const experiment::CompiledExperiment& experiment, std::optional<predict::Criterion> criterion,
                        std::optional<double> handMass);

}  // namespace reachlab::subjects
