#pragma once
#include <memory>

#include "sim/predict/line_object.h"
#include "sim/predict/predict.h"

namespace reachlab::predict {

enum class Precise { AsNeeded, Always };

/// Criteria 1, 4, 5, 6 and the hand-crackle variant for any linear object by the state-space form of criteria.md 5: damping, hand
/// damping, and (Precise::Always) undamped objects whose conditioning asks for more digits than a double has. With AsNeeded the
/// wider arithmetic is taken only where the double's condition makes it worthwhile. Fills everything but peaks and travel time.
std::unique_ptr<Prediction> makeSeriesPrediction(const LineObject& object, Criterion criterion, double distance, double duration,
                                                 Precise precise = Precise::AsNeeded);

}  // namespace reachlab::predict
