#include "sim/predict/prediction/criterion.h"

#include <array>

namespace reachlab::predict {
namespace {

struct CriterionText {
  std::string_view name, words;
};
// In the order of the enumeration.
constexpr std::array<CriterionText, kCriterionCount> kTexts{{
    {"min-hand-jerk", "least squared jerk of the hand, criterion (1)"},
    {"min-torque-change", "least squared change of the joint torques of a two-link arm, criterion (2)"},
    {"min-crackle", "least squared derivative of order 2N+3 of the object, criterion (3)"},
    {"min-hand-force", "least squared driving force of the hand, criterion (4)"},
    {"min-hand-force-change", "least squared rate of change of the driving force, criterion (5)"},
    {"min-com-acceleration", "least squared acceleration of the centre of mass, criterion (6)"},
    {"min-hand-crackle", "least squared fifth derivative of the hand, criterion (3) read literally"},
}};

}  // namespace

std::vector<Criterion> orAll(const std::vector<Criterion>& named) {
  return named.empty() ? std::vector<Criterion>(kAllCriteria.begin(), kAllCriteria.end()) : named;
}

std::string_view nameOf(Criterion criterion) { return kTexts[static_cast<size_t>(criterion)].name; }
std::string_view describe(Criterion criterion) { return kTexts[static_cast<size_t>(criterion)].words; }

std::optional<Criterion> criterionFromName(std::string_view name) {
  for (const Criterion criterion : kAllCriteria)
    if (nameOf(criterion) == name) return criterion;
  return std::nullopt;
}

}  // namespace reachlab::predict
