#pragma once
#include <memory>

#include "sim/predict/line/line_object.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Criterion 3: least squared derivative of order 2N+3 of the flat output z (docs/theory/criteria.md, "Minimum crackle"), which is the
/// last mass of an undamped chain. z = L I_{t/T}(2N+3, 2N+3) whatever masses and springs are; hand and masses are h = P(D) z, x_i = p_i(D)
/// z with polynomials of positive coefficients, dampers included (x_N = prod (1 + (b_j/k_j) D) z in a damped chain). The hand's own mass
/// and damping do not enter. `condition` is the largest factor by which the derivatives' sum loses digits. Fills everything but
/// peaks and travel time.
std::unique_ptr<Prediction> makeCracklePrediction(const LineObject& object, double distance, double duration);

}  // namespace reachlab::predict
