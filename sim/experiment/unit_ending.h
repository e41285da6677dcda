#pragma once
#include <string_view>

namespace reachlab::experiment {

/// A key of a file or column of a table without the unit that it ends in: "duration_s" is "duration" in "s".
struct NamedQuantity {
  std::string_view name;  // part of what was given
  std::string_view unit;  // as in "N s/m", "m/s^2"; empty: none
};
NamedQuantity splitUnit(std::string_view key);

}  // namespace reachlab::experiment
