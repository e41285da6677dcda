#include "sim/experiment/unit_ending.h"

#include <utility>

namespace reachlab::experiment {

NamedQuantity splitUnit(std::string_view key) {
  // An ending stands before those that it ends in.
  static constexpr std::pair<std::string_view, std::string_view> kEndings[] = {{"_n_m_s_per_rad", "N m s/rad"},
                                                                               {"_n_s_per_m", "N s/m"},
                                                                               {"_n_per_m", "N/m"},
                                                                               {"_m_per_s2", "m/s^2"},
                                                                               {"_m_per_s", "m/s"},
                                                                               {"_rad_per_s", "rad/s"},
                                                                               {"_q1_per_s", "1/s"},
                                                                               {"_q2_per_s", "1/s"},
                                                                               {"_percent", "%"},
                                                                               {"_years", "years"},
                                                                               {"_kg_m2", "kg m^2"},
                                                                               {"_kg", "kg"},
                                                                               {"_deg", "°"},
                                                                               {"_hz", "Hz"},
                                                                               {"_s", "s"},
                                                                               {"_m", "m"},
                                                                               {"_n", "N"},
                                                                               {"_j", "J"}};
  for (const auto& [ending, unit] : kEndings)
    if (key.ends_with(ending)) return {key.substr(0, key.size() - ending.size()), unit};
  return {key, {}};
}

}  // namespace reachlab::experiment
