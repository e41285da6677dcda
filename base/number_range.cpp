#include "base/number_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/names.h"

namespace reachlab {
namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}

NumberRange anyNumber() { return {-kInfinity, kInfinity, true, "any finite number"}; }
NumberRange positive(const std::string& unit) { return {0, kInfinity, false, fmt::format("more than 0 {}", unit)}; }
NumberRange wholeNumber(double lo, double hi) { return {lo, hi, true, fmt::format("a whole number from {} to {}", lo, hi), true}; }
NumberRange positiveUpTo(double most, const std::string& unit) {
  const std::string ending = unit.empty() ? "" : " " + unit;
  return {0, most, false, fmt::format("more than 0{}, at most {:.0f}{}", ending, most, ending)};
}

bool isWithin(const NumberRange& range, double value) {
  return std::isfinite(value) && (range.loIncluded ? value >= range.lo : value > range.lo) && value <= range.hi &&
         (!range.whole || value == std::floor(value));
}

void checkNumber(const std::string& key, double value, const NumberRange& range, std::vector<Fault>& faults) {
  if (!isWithin(range, value)) faults.push_back({key, fmt::format("is {}", value), range.allowed});
}

void checkNumbers(const std::string& key, const std::vector<double>& values, int count, const NumberRange& range,
                  std::vector<Fault>& faults) {
  if (count >= 0 && values.size() != static_cast<std::size_t>(count))
    return faults.push_back({key, fmt::format("has {} element{}", values.size(), values.size() == 1 ? "" : "s"),
                             fmt::format("an array of {} number{}", count, count == 1 ? "" : "s")});
  for (std::size_t i = 0; i < values.size(); ++i) checkNumber(fmt::format("{}[{}]", key, i), values[i], range, faults);
}

void checkChoice(const std::string& key, const std::string& name, const std::vector<std::string>& names, std::vector<Fault>& faults) {
  if (std::find(names.begin(), names.end(), name) == names.end()) faults.push_back({key, fmt::format("is \"{}\"", name), listOf(names)});
}

}  // namespace reachlab
