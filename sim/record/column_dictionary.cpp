#include "sim/record/column_dictionary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace reachlab {

std::string unitOfColumn(std::string_view column) {
  // An ending stands before those that it ends in.
  static constexpr std::pair<std::string_view, std::string_view> kEndings[] = {{"_m_per_s2", "m/s^2"},
                                                                               {"_m_per_s", "m/s"},
                                                                               {"_rad_per_s", "rad/s"},
                                                                               {"_q1_per_s", "1/s"},
                                                                               {"_q2_per_s", "1/s"},
                                                                               {"_percent", "%"},
                                                                               {"_years", "years"},
                                                                               {"_kg", "kg"},
                                                                               {"_hz", "Hz"},
                                                                               {"_s", "s"},
                                                                               {"_m", "m"},
                                                                               {"_n", "N"},
                                                                               {"_j", "J"}};
  if (column == "percent") return "%";
  for (const auto& [ending, unit] : kEndings)
    if (column.ends_with(ending)) return std::string(unit);
  return {};
}

std::string columnDictionary(std::string_view csv, std::span<const ColumnMeaning> meanings) {
  nlohmann::ordered_json dictionary = nlohmann::ordered_json::object();
  std::string_view header = csv.substr(0, csv.find('\n'));
  while (!header.empty()) {
    const std::string_view column = header.substr(0, header.find(','));
    header.remove_prefix(std::min(header.size(), column.size() + 1));
    const auto found = std::find_if(meanings.begin(), meanings.end(), [&](const ColumnMeaning& m) {
      return m.column.ends_with('*') ? column.starts_with(m.column.substr(0, m.column.size() - 1)) : column == m.column;
    });
    auto& entry = dictionary[std::string(column)];
    entry["Description"] = found == meanings.end() ? "" : found->meaning;
    if (const std::string unit = unitOfColumn(column); !unit.empty()) entry["Units"] = unit;
    if (column == "subject" || column == "session") entry["Format"] = "string";
  }
  return dictionary.dump(2) + "\n";
}

std::string dictionaryPathOf(const std::string& csvPath) { return csvPath.substr(0, csvPath.rfind('.')) + ".json"; }

}  // namespace reachlab
