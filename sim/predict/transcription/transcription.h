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
  double condition = 0;  // root of the last Newton matrix's, as it is of a square, its diagonal scaled to one
  int iterations = 0;
  double uncertainty = 0;  // likely error of the profile, of its peak, by which the number of unknowns is judged
  double errorBound = 0;   // what it is said to be; 0 where it was found from neighbours and nothing is known

  /// d^m y / dt^m of one motion as a Legendre series in x = 2t/T - 1.
  LegendreSeries derivative(int motion, int m) const;
  /// y and its first three derivatives at t.
  std::array<double, 4> at(int motion, double t) const;
};

/// Newton's method with exact second derivatives and a line search, from `guess` (unknowns of each motion, as many as given; the
/// rest 0). Throws RefusedError when it does not settle.
TranscribedMotion solveTranscription(const TranscribedProblem& problem, int unknowns, const std::vector<std::vector<double>>& guess);

/// Error of a profile after its unknowns were raised by half for the last time, when the last two raises changed it by `before`
/// and `change`: the error falls geometrically with the number of unknowns, and the last raise was half as large again as the one
/// before.
double estimateError(double change, double before);
/// The same without trust in the longer raise, as convergence is seldom that even, and not below what rounding may do: errors of the
/// whole catalogue are at most three times it.
double boundError(double change, double before);

/// The same from several starts, the straight one and others bent from it; the lowest minimum wins. Then the number of unknowns is
/// raised by half until the motions' velocities are known to 1e-8 of their peak and checkPath() finds nothing that was not seen, or
/// `unknowns` > 0 as given, and the error from half as many again. Where 450 are not enough the result says how far it is known; above 1e-2, and where the movement is not
/// smooth, it is refused. `placeOf` (may be empty) is the hand in space at time t.
TranscribedMotion solveFromStarts(const TranscribedProblem& problem, int unknowns, const HandInSpace& placeOf = {});

/// From the unknowns of predictions `near` in duration, which all have equally many: those of the six nearest, continued to this duration as
/// polynomials. nullopt where there are none, or Newton's method does not settle. One unknown motion.
std::optional<TranscribedMotion> solveFromNeighbours(const TranscribedProblem& problem, std::span<const Prediction* const> near);

/// Hand and masses given as Legendre series in x = 2t/T - 1.
struct MotionSeries {
  LegendreSeries position, velocity, acceleration;
};
/// Position from 0 along a movement of this speed [m/s], by time; `columns`: of the motion's basis.
MotionSeries makeSeriesOfSpeed(const std::function<double(double t)>& speed, int columns, double duration);
/// From the velocity [m/s] over x; position from 0.
MotionSeries makeSeriesOfVelocity(const LegendreSeries& velocity, double duration);
/// What is said of a point mass on a curve or a surface.
inline constexpr const char* kMovesAsOne = "on a curve or surface hand and mass move as one; positions are metres of arc length";
/// Cost, condition and what the reader must know of the motion.
void describeMotion(const TranscribedMotion& motion, Prediction& prediction);
std::unique_ptr<Prediction> makeLegendrePrediction(MotionSeries hand, std::vector<MotionSeries> masses, double duration);

}  // namespace reachlab::predict
