#pragma once
#include <complex>
#include <vector>

#include "sim/dynamics/object/object_model.h"

namespace reachlab::dynamics {

/// Eigenvalues [1/s] of the linear dynamics of the object along one line, or of a body's six freedoms at rest, conjugates included. Above 100
/// masses only the bound of boundFastestMode is returned, as one undamped and one real mode. Allocates.
std::vector<std::complex<double>> computeEigenvalues(const ObjectModel& model);

inline constexpr double kRk4ImaginaryLimit = 2.8284271247461903;  // 2 sqrt 2: |R(iy)| = 1
inline constexpr double kRk4RealLimit = 2.7852935634052817;       // |R(-x)| = 1

/// |1 + z + z^2/2 + z^3/6 + z^4/24|, by which classic RK4 multiplies a mode with z = eigenvalue times step.
double rk4Amplification(std::complex<double> z);
/// True if no mode grows.
bool isRk4Stable(const std::vector<std::complex<double>>& eigenvalues, double step);
/// The longest stable step [s].
double findRk4StepLimit(const std::vector<std::complex<double>>& eigenvalues);

/// Position error of RK4 [m] over one reach of `length` [m] in `duration` [s]. Each step adds a phase error of |z|^5/120 to every mode.
/// Under a minimum-jerk hand the amplitude of a mode is at most 60 length / (w T)^3, from the jump of the jerk.
double predictRk4Error(const std::vector<std::complex<double>>& eigenvalues, double step, double length, double duration);

}  // namespace reachlab::dynamics
