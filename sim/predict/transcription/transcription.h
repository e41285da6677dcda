#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/predict/prediction/prediction.h"
#include "sim/predict/transcription/path_check.h"
#include "sim/predict/transcription/transcribed_cost.h"

namespace reachlab::predict {

struct TranscribedMotion;
using HandInSpace = std::function<PathPoint(const TranscribedMotion& motion, double t)>;

struct TranscribedMotion {
  RestToRestBasis basis;
  std::vector<std::vector<double>> coefficient;  // per motion: distance, then the unknowns
  std::vector<double> start;
  double duration = 0;
  double cost = 0;
  double condition = 0;    // root of the last Newton matrix's, as it is of a square, its diagonal scaled to one
  double uncertainty = 0;  // likely error of the profile, of its peak, by which the number of unknowns is judged
  double errorBound = 0;   // what it is said to be; 0 where it was found from neighbours and nothing is known

  /// d^m y / dt^m of one motion as a Legendre series in x = 2t/T - 1.
  LegendreSeries derivative(int motion, int m) const;
  /// y and its first three derivatives at t.
  std::array<double, 4> at(int motion, double t) const;
};

/// Newton's method with exact second derivatives and a line search. It starts from `guess` (some first unknowns of each motion, the rest
/// 0). Throws RefusedError when it does not settle.
TranscribedMotion solveTranscription(const TranscribedProblem& problem, int unknowns, const std::vector<std::vector<double>>& guess);

/// Error of a profile after its number of unknowns was raised by half for the last time. The last two raises changed it by `before` and
/// `change`. The error falls geometrically with the number of unknowns, and the last raise was half as large again as the raise before.
double estimateError(double change, double before);
/// The same without trust in the longer raise, as convergence is seldom that even, and not below the effect of rounding. Errors of the
/// whole catalogue are at most three times it.
double boundError(double change, double before);

/// The same from several starts: the straight movement and others bent from it. The lowest minimum wins. With `unknowns` > 0 their number
/// is fixed, and the error is found with half as many again. Otherwise the number is raised by half until the motions' velocities are known
/// to 1e-8 of their peak and checkPath() finds nothing new. Where 450 are not enough the result gives its error. The result is refused if
/// that error is above 1e-2, or if the movement is not smooth. `placeOf` (may be empty) is the hand in space at time t.
TranscribedMotion solveFromStarts(const TranscribedProblem& problem, int unknowns, const HandInSpace& placeOf = {});

/// Starts from the unknowns of predictions `near` in duration, which all have equally many. Those of the six nearest are continued to this
/// duration as polynomials. nullopt if `near` is empty, or if Newton's method does not settle. One unknown motion.
std::optional<TranscribedMotion> solveFromNeighbours(const TranscribedProblem& problem, std::span<const Prediction* const> near);

/// Hand and masses given as Legendre series in x = 2t/T - 1.
struct MotionSeries {
  LegendreSeries position, velocity, acceleration;
};
/// Position from 0 along a movement of this speed [m/s], as a function of time. `columns` belongs to the motion's basis.
MotionSeries makeSeriesOfSpeed(const std::function<double(double t)>& speed, int columns, double duration);
/// From the velocity [m/s] over x, with position from 0.
MotionSeries makeSeriesOfVelocity(const LegendreSeries& velocity, double duration);
/// Remark for a point mass on a curve or a surface.
inline constexpr const char* kMovesAsOne = "on a curve or surface hand and mass move as one; positions are metres of arc length";
/// Fills in cost, condition and the warnings about the motion.
void describeMotion(const TranscribedMotion& motion, Prediction& prediction);
std::unique_ptr<Prediction> makeLegendrePrediction(MotionSeries hand, std::vector<MotionSeries> masses, double duration);

}  // namespace reachlab::predict
