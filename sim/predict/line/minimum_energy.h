#pragma once
#include "sim/predict/line/control_problem.h"
#include "sim/predict/numerics/piecewise_series.h"

namespace reachlab::predict {

/// The movement of least integral of u^2 from rest to the target (minimum-energy control).
struct MinimumEnergyMotion {
  PiecewiseSeries profile;
  double cost = 0;       // int u^2
  double condition = 0;  // of the root of the Gramian, its states turned to the object's modes and scaled to one; infinite: singular
  double fastest = 0;    // [1/s] bound of the object's rates
  double miss = 0;       // how far the states end from the target, in their own units: the computation checks itself
};

/// The control is u(t) = b^T e^{A^T (T-t)} W^-1 x_T with the Gramian W = int_0^T e^{A s} b b^T e^{A^T s} ds (docs/theory/criteria.md,
/// "Pontryagin's conditions", and Kailath, Linear Systems, 9.2). e^{A s} and W begin with a time so short that their Taylor series are
/// short. Then the time is doubled repeatedly: W(2s) = W(s) + e^{A s} W(s) e^{A^T s} (Van Loan, IEEE Trans. Automat. Contr. 23 (1978) 395).
/// The arithmetic is double where the condition is small and the resulting movement settles. Otherwise it has 32 digits, of which W loses
/// the square of the condition. The error of the end state is corrected once or twice. Nothing is diagonalised, so double eigenvalues and
/// strong damping need no special case. Throws RefusedError when the object's fastest rate times `duration` is above kFastestTimesDuration.
MinimumEnergyMotion solveMinimumEnergy(const ControlProblem& system, double duration);
inline constexpr double kFastestTimesDuration = 32768;

}  // namespace reachlab::predict
