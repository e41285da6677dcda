#pragma once
#include <memory>

#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Criteria 1, 4, 5, 6 and the hand-crackle variant for an undamped object, in closed form (docs/theory/criteria.md, "Least norm form"). It
/// has N+2 (N+3) unknowns, and its profiles are symmetric about T/2. Fills everything except the peaks and the travel time.
std::unique_ptr<Prediction> makeSymmetricPrediction(const LineObject& object, Criterion criterion, double distance, double duration);

/// The same for a hand that is one with its point: no spring between them, `mass` [kg] of both. (3) is then (1).
std::unique_ptr<Prediction> makeRigidPrediction(double mass, Criterion criterion, double distance, double duration);

}  // namespace reachlab::predict
