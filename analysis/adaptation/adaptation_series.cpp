#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/adaptation/state_space.h"
#include "base/csv_table.h"
#include "base/fault.h"

namespace reachlab::analysis {

AdaptationSeries readAdaptationSeries(const std::string& file) {
  const CsvTable table = readCsvTable(file);
  const auto columnOf = [&](const char* name) {
    if (const auto count = std::count(table.columns.begin(), table.columns.end(), name); count != 1)
      throw FaultError(Fault{name, count == 0 ? "column is missing" : "column stands there more than once",
                             fmt::format("a header with perturbation,response; this one has {}", fmt::join(table.columns, ", ")),
                             FilePlace{file, 1}});
    return *table.find(name);
  };
  const std::size_t perturbation = columnOf("perturbation"), response = columnOf("response");
  AdaptationSeries series;
  for (const CsvTable::Row& row : table.rows) {
    const auto cell = [&](std::size_t column) {
      return row.cells[column].empty() ? std::nullopt : std::optional(numberIn(table, row, column));
    };
    series.push_back({cell(perturbation), cell(response)});
  }
  return series;
}

}  // namespace reachlab::analysis
