#pragma once
#include <functional>
#include <memory>
#include <span>

#include "analysis/conclusions/profile_family.h"
#include "sim/predict/prediction/prediction.h"

namespace reachlab::analysis {

/// Predicts for a duration [s], started from other predictions (predict::PredictOptions::near) or from nothing. Null if nothing can be
/// predicted. Any thread.
using Predictor = std::function<std::unique_ptr<predict::Prediction>(double duration, std::span<const predict::Prediction* const> near)>;

/// (T/L) v(sT) at equally spaced s from 0 to 1. False if a number is not finite.
bool sampleProfile(const predict::Prediction& prediction, std::span<double> phi);

/// A sampler of profiles that take long to predict. Profiles at multiples of `spacing` [s] are found from one another, a few neighbours
/// at a time. The first is found from the prediction for `typical` [s]. The same numbers in whatever order they are asked for, by
/// whatever threads. Other durations are predicted from nothing. Always asked for the same number of instants.
ProfileFamily::Sampler sampleNearPredictions(Predictor predictor, double typical, double spacing);

}  // namespace reachlab::analysis
