#pragma once
#include <memory>

#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Criteria 1, 4, 5, 6 and the hand-crackle variant for any linear object, in 32 digits. The state-space form is in
/// docs/theory/criteria.md, "Pontryagin's conditions". It serves objects with damping, a damped hand, and undamped objects whose
/// conditioning needs more digits than a double has. Fills everything except peaks and travel time.
std::unique_ptr<Prediction> makeMinimumEnergyPrediction(const LineObject& object, Criterion criterion, double distance, double duration);

}  // namespace reachlab::predict
