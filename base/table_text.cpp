#include "base/table_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "base/as_number.h"

namespace reachlab {

TableText& TableText::raw(std::string_view text) {
  if (rowBegun_) text_ += separator_;
  text_ += text;
  rowBegun_ = true;
  return *this;
}

TableText& TableText::cell(std::string_view text) {
  if (text.empty()) return missing();
  if (separator_ != ',') {
    std::string clean(text);
    for (char& c : clean)
      if (c == '\t' || c == '\n' || c == '\r') c = ' ';
    return raw(clean);
  }
  // A spreadsheet would take such a text for a formula and carry it out.
  const bool guarded = std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos && !asNumber<double>(text);
  if (!guarded && text.find_first_of(",\"\r\n") == std::string_view::npos) return raw(text);
  std::string quoted = guarded ? "\"'" : "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return raw(quoted + "\"");
}

TableText& TableText::number(double value) {
  if (!std::isfinite(value)) return missing();
  if (rowBegun_) text_ += separator_;
  rowBegun_ = true;
  // 17 significant digits for CSV as everywhere on the command line; the shortest that reads back equal for TSV.
  if (separator_ == ',') fmt::format_to(std::back_inserter(text_), "{:.17g}", value);
  else fmt::format_to(std::back_inserter(text_), "{}", value);
  return *this;
}

TableText& TableText::whole(long long value) { return raw(fmt::format("{}", value)); }

void TableText::endRow() {
  text_ += '\n';
  rowBegun_ = false;
}

void TableText::row(const std::vector<std::string>& cells) {
  for (const std::string& text : cells) cell(text);
  endRow();
}

TsvTable parseTsv(const std::string& text) {
  TsvTable table;
  std::vector<std::string> cells(1);
  const auto finishRow = [&] {
    if (cells.size() == 1 && cells[0].empty()) return;
    if (table.columns.empty()) {
      table.columns = cells;
    } else {
      cells.resize(table.columns.size(), "n/a");
      table.rows.push_back(cells);
    }
    cells.assign(1, "");
  };
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  for (std::size_t i = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0; i < text.size(); ++i) {
    if (text[i] == '\t') cells.emplace_back();
    else if (text[i] == '\n' || text[i] == '\r') finishRow();
    else cells.back() += text[i];
  }
  finishRow();
  return table;
}

std::string toText(const TsvTable& table) {
  TableText text('\t', "n/a");
  text.row(table.columns);
  for (const std::vector<std::string>& row : table.rows) text.row(row);
  return text.text();
}

}  // namespace reachlab
