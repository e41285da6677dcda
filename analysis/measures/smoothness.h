#pragma once
#include <cstddef>
#include <span>

/// How smooth a movement is, from its speed alone. Pure functions for any thread.
namespace reachlab::analysis {

/// Spectral arc length (Balasubramanian et al. 2015, J. NeuroEng. Rehab. 12:112): minus the length of the amplitude spectrum's curve,
/// frequency and amplitude each scaled to 1. `speed` >= 0 of the movement alone, at `rate` [Hz]. NaN for fewer than two samples
/// or only zeros. The band ends at 10 Hz, or below it where the amplitude stays under 5 % of the largest. Smoother is nearer to -1.4. No unit.
double computeSparc(std::span<const double> speed, double rate);

/// Log dimensionless jerk (same source): -ln( T^3 / v_max^2 * integral |v''|^2 dt ), T = samples / rate, second differences, no mean
/// removed. At least three samples, NaN otherwise. Smoother is larger. No unit.
double computeLogDimensionlessJerk(std::span<const double> speed, double rate);

/// The number of local maxima with at least that prominence, as a share of the largest value. Prominence is the descent from a maximum
/// before the signal rises to a higher one or ends. A bell-shaped profile has 1.
std::size_t countPeaks(std::span<const double> speed, double prominence = 0.05);

}  // namespace reachlab::analysis
