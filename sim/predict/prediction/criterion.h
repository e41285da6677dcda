#pragma once
#include <optional>
#include <string_view>

namespace reachlab::predict {

/// The optimality criteria of the paper's Table 1, in its order, and the literal hand-crackle variant.
enum class Criterion { MinHandJerk, MinTorqueChange, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration, MinHandCrackle };
inline constexpr int kCriterionCount = 7;
std::string_view nameOf(Criterion criterion);  // "min-hand-jerk", "min-torque-change", …
/// One line of plain words with the paper's equation number.
std::string_view describe(Criterion criterion);
std::optional<Criterion> criterionFromName(std::string_view name);

}  // namespace reachlab::predict
