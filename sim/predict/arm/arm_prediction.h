#pragma once
#include <memory>

#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Where the hand of the arm goes, in the task plane: along the line and across it [m].
struct ArmTask {
  std::array<double, 2> start{}, target{};
  double duration = 0;  // [s]
};

/// Criterion 2: least integral of the squared rates of both joint torques of a planar two-link arm, from rest to rest. The torques are tau
/// = M(q) q'' + C + B q' (+ J^T f of the object). Model and symbols: docs/theory/criteria.md, "Minimum torque change", after Uno, Kawato
/// and Suzuki 1989. The problem is not convex, so the lowest minimum from several starts is given. `unknowns` 0: chosen for 1e-8 of the
/// peak. Free arm: positions are along the chord from start to target. The masses move with the hand and load nothing.
std::unique_ptr<Prediction> makeFreeArmPrediction(const experiment::Arm& arm, const ArmTask& task, int massCount, int unknowns);
/// Along the straight line of the task with the object, and with the hand's own mass and damping. No force acts across the line. Starts
/// from the predictions `near` (PredictOptions::near), where given.
std::unique_ptr<Prediction> makeLineArmPrediction(const experiment::Arm& arm, const ArmTask& task, const LineObject& object, int unknowns,
                                                  std::span<const Prediction* const> near = {});

}  // namespace reachlab::predict
