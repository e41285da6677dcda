#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "sim/predict/gauss_legendre.h"
#include "sim/predict/legendre.h"
#include "sim/predict/predict.h"

namespace reachlab {

/// Least integral of |R(a)|^2 over [0, T], where the local variables a(t) are linear in the unknown motions: the problem of criterion 2
/// and of jerk on curves and surfaces. Several motions may be unknown, each in the same RestToRestBasis.
struct TranscribedProblem {
  double duration = 0;      // [s]
  int order = 3;            // conditions per end of each motion
  int locals = 0, residuals = 0;
  std::vector<double> from, to;  // ends of each unknown motion
  /// locals x (order+1) for each motion: a = sum over motions and m of local[motion][l*(order+1)+m] * y^(m)(t), time derivatives.
  std::vector<std::vector<double>> local;
  /// R, dR/da (residuals x locals) and d2R/da2 (residuals x locals x locals) at one instant; R alone when ra is null.
  std::function<void(const double* a, double* r, double* ra, double* raa)> residual;
};

struct TranscribedMotion {
  RestToRestBasis basis;
  std::vector<std::vector<double>> coefficient;  // per motion: distance, then the unknowns
  std::vector<double> start;
  double duration = 0;
  double cost = 0;
  double condition = 0;  // root of the last Newton matrix's, as it is of a square
  int iterations = 0;
  double uncertainty = 0;  // of the profile, of its peak; 0 where it is below what was asked

  /// d^m y / dt^m of one motion as a Legendre series in x = 2t/T - 1.
  LegendreSeries derivative(int motion, int m) const;
};

/// Newton's method with exact second derivatives and a line search, from `guess` (unknowns of each motion, as many as given; the rest 0).
/// Throws RefusedError when it does not settle.
TranscribedMotion solveTranscription(const TranscribedProblem& problem, int unknowns, const std::vector<std::vector<double>>& guess);

/// Raises the number of unknowns until the first motion's velocity is known to 1e-8 of its peak, or `unknowns` > 0 as given.
/// Where 300 are not enough (close by a cusp) the result says how far it is known; above 1e-2 it is refused.
TranscribedMotion solveTranscriptionAdaptively(const TranscribedProblem& problem, int unknowns, const std::vector<std::vector<double>>& guess);

/// The same from several starts, the straight one and others bent from it; the lowest minimum wins.
TranscribedMotion solveFromStarts(const TranscribedProblem& problem, int unknowns);

/// Hand and masses given as Legendre series in x = 2t/T - 1.
struct SeriesOfOne {
  LegendreSeries position, velocity, acceleration;
};
/// From the velocity [m/s] over x; position from 0.
SeriesOfOne makeSeriesOfVelocity(const LegendreSeries& velocity, double duration);
/// Cost, condition and what the reader must know of the motion.
void describeMotion(const TranscribedMotion& motion, Prediction& prediction);
std::unique_ptr<Prediction> makeLegendrePrediction(SeriesOfOne hand, std::vector<SeriesOfOne> masses, double duration);

}  // namespace reachlab
