#pragma once

namespace reachlab::predict {

/// Condition numbers of the triangular factor (docs/theory/methods.md, "Predictions: least norm and Gramian"). The closed form keeps 1e-11
/// of the peak up to the first, the the state-space form in 32 digits is taken beyond it; above the second the reader is warned, above the
/// third the prediction is refused.
inline constexpr double kClosedFormCondition = 1e2, kWarnCondition = 1e6, kRefuseCondition = 1e12;

}  // namespace reachlab::predict
