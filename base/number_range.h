#pragma once
#include <string>
#include <vector>

#include "base/fault.h"

namespace reachlab {

/// Range of a number, with the text for messages. Files and values are checked against the same ranges.
struct NumberRange {
  double lo = 0, hi = 0;
  bool loIncluded = true;
  std::string allowed = {};
  bool whole = false;
};
NumberRange anyNumber();
NumberRange positive(const std::string& unit);
NumberRange wholeNumber(double lo, double hi);
/// (0, most].
NumberRange positiveUpTo(double most, const std::string& unit);

/// False for a number that is not finite.
bool isWithin(const NumberRange& range, double value);

/// Appends "is VALUE" under `key` where the value is out of range.
void checkNumber(const std::string& key, double value, const NumberRange& range, std::vector<Fault>& faults);
/// The same for each of a list, under `key[i]`, and for their count where `count` >= 0.
void checkNumbers(const std::string& key, const std::vector<double>& values, int count, const NumberRange& range,
                  std::vector<Fault>& faults);
/// Appends "is "NAME"" under `key` if `name` is not in `names`.
void checkChoice(const std::string& key, const std::string& name, const std::vector<std::string>& names, std::vector<Fault>& faults);

}  // namespace reachlab
