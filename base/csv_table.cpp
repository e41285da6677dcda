#include "base/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "base/as_number.h"
#include "base/fault.h"
#include "base/text_file.h"

namespace reachlab {
namespace {

std::vector<std::string> cellsOf(std::string line, char separator) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::istringstream in(line + separator);  // an empty last cell counts
  for (std::string cell; std::getline(in, cell, separator);) {
    const std::size_t begin = cell.find_first_not_of(' ');
    std::string bare = begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1);
    if (bare.size() >= 2 && bare.front() == '"' && bare.back() == '"') bare = bare.substr(1, bare.size() - 2);
    cells.push_back(std::move(bare));
  }
  return cells;
}

char separatorOf(const std::string& header) {
  if (header.find('\t') != std::string::npos) return '\t';
  return header.find(',') == std::string::npos && header.find(';') != std::string::npos ? ';' : ',';
}

}  // namespace

std::optional<std::size_t> CsvTable::find(const std::string& column) const {
  const auto at = std::find(columns.begin(), columns.end(), column);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

CsvTable readCsvTable(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw ResourceError(file + ": cannot be opened");
  std::istringstream in(readTextFile(file));
  std::string line;
  std::getline(in, line);
  if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
  const char separator = separatorOf(line);
  CsvTable table{file, cellsOf(line, separator), {}};
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \r") == std::string::npos) continue;
    CsvTable::Row row{number, cellsOf(line, separator)};
    if (row.cells.size() != table.columns.size())
      throw FaultError(Fault{{},
                             fmt::format("has {} cells", row.cells.size()),
                             fmt::format("{}, as the header", table.columns.size()),
                             FilePlace{file, number}});
    table.rows.push_back(std::move(row));
  }
  return table;
}

double numberIn(const CsvTable& table, const CsvTable::Row& row, std::size_t column) {
  const std::string& cell = row.cells[column];
  const auto value = asNumber<double>(cell);
  if (!value || !std::isfinite(*value))
    throw FaultError(Fault{table.columns[column], fmt::format("'{}' is not a number", cell.substr(0, 40)), "a finite number",
                           FilePlace{table.file, row.line}});
  return *value;
}

}  // namespace reachlab
