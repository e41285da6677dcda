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

/// Criteria 1, 4, 5, 6 and the hand-crackle variant for any linear object, in 32 digits. The state-space form is in
/// docs/theory/criteria.md, "Pontryagin's conditions". It serves objects with damping, a damped hand, and undamped objects whose
/// conditioning needs more digits than a double has. Fills everything except peaks and travel time.
std::unique_ptr<Prediction> makeMinimumEnergyPrediction(const LineObject& object, Criterion criterion, double distance, double duration);

/// Criterion 3: least squared derivative of order 2N+3 of the flat output z, which is the last mass of an undamped chain. See
/// docs/theory/criteria.md, "Minimum crackle". z = L I_{t/T}(2N+3, 2N+3), independent of masses and springs. Hand and masses are h = P(D) z
/// and x_i = p_i(D) z. The polynomials have positive coefficients and include dampers (x_N = prod (1 + (b_j/k_j) D) z in a damped chain).
/// The hand's own mass and damping do not enter. `condition` is the largest factor by which the derivatives' sum loses digits. Fills
/// everything except peaks and travel time.
std::unique_ptr<Prediction> makeCracklePrediction(const LineObject& object, double distance, double duration);

}  // namespace reachlab::predict
