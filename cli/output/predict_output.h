#pragma once
#include <string>
#include <vector>

#include "analysis/figure/figure.h"
#include "sim/predict/sweep/parameter_sweep.h"

namespace reachlab::cli {

/// `samples` rows from 0 to T, inner limits at both ends: hand, then the masses [m], [m/s], [m/s^2], 17 significant digits.
std::string writePredictionCsv(const predict::Prediction& prediction, int samples);
std::string writePredictionJson(const predict::Prediction& prediction);
/// One row per value of the sweep. A refused prediction leaves its numbers empty.
std::string writeSweepCsv(const predict::Sweep& sweep, const std::vector<predict::SweepRow>& rows);

figure::Figure drawPrediction(const predict::Prediction& prediction, int samples);
/// Peaks, their number and the cost against the swept parameter.
figure::Figure drawSweep(const predict::Sweep& sweep, const std::vector<predict::SweepRow>& rows, predict::Criterion criterion);

}  // namespace reachlab::cli
