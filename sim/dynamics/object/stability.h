#pragma once
#include <complex>
#include <vector>

#include "sim/dynamics/object/object_model.h"

namespace reachlab::dynamics {

/// Eigenvalues of the object's linear dynamics along one line [1/s], conjugates included; above 100 masses only the bound of
/// boundFastestMode, as one undamped and one real mode. Allocates.
std::vector<std::complex<double>> computeEigenvalues(const ObjectModel& model);

inline constexpr double kRk4ImaginaryLimit = 2.8284271247461903;  // 2 sqrt 2: |R(iy)| = 1
inline constexpr double kRk4RealLimit = 2.7852935634052817;       // |R(-x)| = 1

/// |1 + z + z^2/2 + z^3/6 + z^4/24|, by which classic RK4 multiplies a mode with z = eigenvalue times step.
double rk4Amplification(std::complex<double> z);
/// No mode grows.
bool isRk4Stable(const std::vector<std::complex<double>>& eigenvalues, double step);
/// The longest stable step [s].
double findRk4StepLimit(const std::vector<std::complex<double>>& eigenvalues);

/// Error of RK4 over one reach of `length` [m] in `duration` [s], a position: phase errors |z|^5/120 a step of every mode, whose amplitude
/// under a minimum-jerk hand is at most 60 length / (w T)^3 (the jump of its jerk).
double predictRk4Error(const std::vector<std::complex<double>>& eigenvalues, double step, double length, double duration);

}  // namespace reachlab::dynamics
