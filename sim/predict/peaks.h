#pragma once
#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

/// Fills handPeak, handPeakTime and objectPeak: the largest |v| on [0+, T-] with its sign, refined between samples. Of equal peaks (within
/// 1e-12 of each other) it takes the earliest.
void findPeaks(Prediction& prediction);

}  // namespace reachlab::predict
