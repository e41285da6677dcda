#pragma once
#include <memory>

#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Criteria 1, 4, 5, 6 and the hand-crackle variant for any linear object by the state-space form of docs/theory/criteria.md,
/// "Pontryagin's conditions", in 32 digits: with damping, with damping of the hand, and undamped where the conditioning asks for more
/// digits than a double has. Fills everything but peaks and travel time.
std::unique_ptr<Prediction> makeMinimumEnergyPrediction(const LineObject& object, Criterion criterion, double distance, double duration);

}  // namespace reachlab::predict
