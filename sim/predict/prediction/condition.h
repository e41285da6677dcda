#pragma once

namespace reachlab::predict {

/// Condition numbers of the triangular factor (docs/theory/methods.md, "Predictions: least norm and Gramian"). Up to kClosedFormCondition
/// the closed form keeps 1e-11 of the peak. Beyond it the state-space form in 32 digits is taken. Above kWarnCondition the reader is
/// warned, and above kRefuseCondition the prediction is refused.
inline constexpr double kClosedFormCondition = 1e2, kWarnCondition = 1e6, kRefuseCondition = 1e12;

}  // namespace reachlab::predict
