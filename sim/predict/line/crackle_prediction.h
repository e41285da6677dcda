#pragma once
#include <memory>

#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Criterion 3: least squared derivative of order 2N+3 of the flat output z, which is the last mass of an undamped chain. See
/// docs/theory/criteria.md, "Minimum crackle". z = L I_{t/T}(2N+3, 2N+3), independent of masses and springs. Hand and masses are h = P(D) z
/// and x_i = p_i(D) z. The polynomials have positive coefficients and include dampers (x_N = prod (1 + (b_j/k_j) D) z in a damped chain).
/// The hand's own mass and damping do not enter. `condition` is the largest factor by which the derivatives' sum loses digits. Fills
/// everything except peaks and travel time.
std::unique_ptr<Prediction> makeCracklePrediction(const LineObject& object, double distance, double duration);

}  // namespace reachlab::predict
