#include "sim/record/export/column_dictionary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/experiment/unit_ending.h"

namespace reachlab::record {

std::string unitOfColumn(std::string_view column) {
  if (column == "percent") return "%";
  return std::string(experiment::splitUnit(column).unit);
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
    nlohmann::ordered_json entry = nlohmann::ordered_json::object();  // made whole before its first key: its own allocation may fail
    entry["Description"] = found == meanings.end() ? "" : found->meaning;
    if (const std::string unit = unitOfColumn(column); !unit.empty()) entry["Units"] = unit;
    if (column == "subject" || column == "session") entry["Format"] = "string";
    dictionary[std::string(column)] = std::move(entry);
  }
  return dictionary.dump(2) + "\n";
}

std::string dictionaryPathOf(const std::string& csvPath) { return csvPath.substr(0, csvPath.rfind('.')) + ".json"; }

}  // namespace reachlab::record
