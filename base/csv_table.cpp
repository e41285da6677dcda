#include "base/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/as_number.h"
#include "base/fault.h"
#include "base/text_file.h"

namespace reachlab {
namespace {

/// Takes the next row off `rest`. In quotes a cell may have separators, line breaks and doubled quotes, as RFC 4180 says.
std::vector<std::string> takeRow(std::string_view& rest, char separator, int& line) {
  std::vector<std::string> cells(1);
  bool quoted = false, closed = false;  // `closed`: spaces behind the quotes are left out
  const auto endCell = [&] {
    if (!closed) cells.back().erase(cells.back().find_last_not_of(" \r") + 1);
    closed = false;
  };
  while (!rest.empty()) {
    const char c = rest.front();
    rest.remove_prefix(1);
    if (c == '\n') ++line;
    if (quoted) {
      if (c != '"') cells.back() += c;
      else if (rest.starts_with('"')) cells.back() += c, rest.remove_prefix(1);
      else quoted = false, closed = true;
    } else if (c == '\n') {
      break;
    } else if (c == separator) {
      endCell();
      cells.emplace_back();
    } else if (cells.back().empty() && !closed && (c == '"' || c == ' ')) {
      quoted = c == '"';
    } else if (!closed) {
      cells.back() += c;
    }
  }
  endCell();
  return cells;
}

char separatorOf(std::string_view header) {
  if (header.find('\t') != header.npos) return '\t';
  return header.find(',') == header.npos && header.find(';') != header.npos ? ';' : ',';
}

}  // namespace

std::optional<std::size_t> CsvTable::find(const std::string& column) const {
  const auto at = std::find(columns.begin(), columns.end(), column);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

CsvTable readCsvTable(const std::string& file) {
  if (!isThere(file)) throw ResourceError(file + ": cannot be opened");
  const std::string text = readTextFile(file);
  std::string_view rest = text;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  const char separator = separatorOf(rest.substr(0, rest.find('\n')));
  int line = 1;
  CsvTable table{file, takeRow(rest, separator, line), {}};
  while (!rest.empty()) {
    CsvTable::Row row{line, takeRow(rest, separator, line)};
    if (row.cells == std::vector<std::string>{""}) continue;
    if (row.cells.size() != table.columns.size())
      throw FaultError(Fault{{},
                             fmt::format("has {} cells", row.cells.size()),
                             fmt::format("{}, as the header", table.columns.size()),
                             FilePlace{file, row.line}});
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
