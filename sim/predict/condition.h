#pragma once

namespace reachlab::predict {

/// Condition numbers of the triangular factor (criteria.md 5). The closed form keeps 1e-11 of the peak up to the first, the
/// state-space form in doubles up to the second, refined in DoubleDouble beyond it; above the third the reader is warned, above the
/// fourth the prediction is refused.
inline constexpr double kClosedFormCondition = 1e2, kDoubleCondition = 1e3, kWarnCondition = 1e6, kRefuseCondition = 1e12;

}  // namespace reachlab::predict
