#pragma once
#include <memory>
#include <vector>

#include "sim/predict/predict.h"
#include "sim/predict/transcribed_cost.h"

namespace reachlab::predict {

struct TranscribedMotion {
  RestToRestBasis basis;
  std::vector<std::vector<double>> coefficient;  // per motion: distance, then the unknowns
  std::vector<double> start;
  double duration = 0;
  double cost = 0;
  double condition = 0;  // root of the last Newton matrix's, as it is of a square, its diagonal scaled to one
  int iterations = 0;
  double uncertainty = 0;  // of the profile, of its peak; 0 where it is below what was asked

  /// d^m y / dt^m of one motion as a Legendre series in x = 2t/T - 1.
  LegendreSeries derivative(int motion, int m) const;
};

/// Newton's method with exact second derivatives and a line search, from `guess` (unknowns of each motion, as many as given; the
/// rest 0). Throws RefusedError when it does not settle.
TranscribedMotion solveTranscription(const TranscribedProblem& problem, int unknowns, const std::vector<std::vector<double>>& guess);

/// Error of a profile after its unknowns were raised by half for the last time, when the last two raises changed it by `before`
/// and `change`: the error falls geometrically with the number of unknowns, and the last raise was half as large again as the one
/// before.
double estimateError(double change, double before);

/// Raises the number of unknowns by half until the motions' velocities are known to 1e-8 of their peak, or `unknowns` > 0 as
/// given. Where 450 are not enough the result says how far it is known; above 1e-2 it is refused.
TranscribedMotion solveTranscriptionAdaptively(const TranscribedProblem& problem, int unknowns,
                                               const std::vector<std::vector<double>>& guess);

/// The same from several starts, the straight one and others bent from it; the lowest minimum wins.
TranscribedMotion solveFromStarts(const TranscribedProblem& problem, int unknowns);

/// Hand and masses given as Legendre series in x = 2t/T - 1.
struct SeriesOfOne {
  LegendreSeries position, velocity, acceleration;
};
/// From the velocity [m/s] over x; position from 0.
SeriesOfOne makeSeriesOfVelocity(const LegendreSeries& velocity, double duration);
/// What is said of a point mass on a curve or a surface.
inline constexpr const char* kMovesAsOne = "on a curve or surface hand and mass move as one; positions are metres of arc length";
/// Cost, condition and what the reader must know of the motion.
void describeMotion(const TranscribedMotion& motion, Prediction& prediction);
std::unique_ptr<Prediction> makeLegendrePrediction(SeriesOfOne hand, std::vector<SeriesOfOne> masses, double duration);

}  // namespace reachlab::predict
