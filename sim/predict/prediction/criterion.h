#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace reachlab::predict {

/// The optimality criteria of the paper's Table 1, in its order, and the literal hand-crackle variant.
enum class Criterion { MinHandJerk, MinTorqueChange, MinCrackle, MinHandForce, MinHandForceChange, MinComAcceleration, MinHandCrackle };
inline constexpr std::array kAllCriteria{Criterion::MinHandJerk,   Criterion::MinTorqueChange,    Criterion::MinCrackle,
                                         Criterion::MinHandForce,  Criterion::MinHandForceChange, Criterion::MinComAcceleration,
                                         Criterion::MinHandCrackle};
inline constexpr int kCriterionCount = static_cast<int>(kAllCriteria.size());
/// The named criteria, or all criteria if the list is empty.
std::vector<Criterion> orAll(const std::vector<Criterion>& named);
std::string_view nameOf(Criterion criterion);  // "min-hand-jerk", "min-torque-change", …
/// One line of plain words with the paper's equation number.
std::string_view describe(Criterion criterion);
std::optional<Criterion> criterionFromName(std::string_view name);

}  // namespace reachlab::predict
