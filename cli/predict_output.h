#pragma once
#include <string>
#include <vector>

#include "sim/figure/figure.h"
#include "sim/predict/family.h"

namespace reachlab {

/// `samples` rows from 0 to T, inner limits at both ends: hand, then the masses [m], [m/s], [m/s^2], 17 significant digits.
std::string writePredictionCsv(const Prediction& prediction, int samples);
std::string writePredictionJson(const Prediction& prediction);
/// One row a value of the sweep; what was refused leaves its numbers empty.
std::string writeFamilyCsv(const Sweep& sweep, const std::vector<FamilyRow>& rows);

Figure drawPrediction(const Prediction& prediction, int samples);
/// Peaks, their number and the cost against the swept parameter.
Figure drawFamily(const Sweep& sweep, const std::vector<FamilyRow>& rows, Criterion criterion);

}  // namespace reachlab
