#pragma once
#include <optional>
#include <string>
#include <vector>

#include "analysis/table_columns.h"
#include "analysis/tables.h"
#include "base/table_text.h"

namespace reachlab::analysis {

/// A table that goes to its file piece by piece. Its header is that of tableColumns. Columns that differ from
/// analysis to analysis follow.
class Sheet {
 public:
  Sheet(const TableWriter& write, const char* file, const std::vector<std::string>& further = {}) : write_(write), name_(file) {
    for (const record::ColumnMeaning& column : tableColumns(file))
      if (!column.column.ends_with('*')) table_.cell(column.column);
    for (const std::string& column : further) table_.cell(column);
    table_.endRow();
  }
  ~Sheet() = default;
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;

  /// Cells as in TableText. An interval fills two with its ends. Without an interval these are empty.
  template <class... Cells>
  Sheet& cells(const Cells&... values) {
    return (add(values), ..., *this);
  }
  template <class... Cells>
  void row(const Cells&... values) {
    cells(values...);
    endRow();
  }
  void endRow() {
    constexpr std::size_t kPiece = std::size_t{1} << 20;
    table_.endRow();
    if (table_.text().size() > kPiece) flush();
  }
  void flush() { write_(name_, table_.takeText()); }

 private:
  template <class Cell>
  void add(const Cell& value) {
    table_.cells(value);
  }
  void add(const std::optional<Bounds>& bounds) {
    const bool known = bounds && bounds->finite();
    table_.cells(known ? bounds->low : kNotMeasured, known ? bounds->high : kNotMeasured);
  }
  void add(const Bounds& bounds) { add(std::optional(bounds)); }

  const TableWriter& write_;
  std::string name_;
  TableText table_{',', ""};
};

/// A whole table: `fill` adds the rows of `content` to the sheet.
template <class Content>
void writeSheet(const TableWriter& write, const char* file, const Content& content, void (*fill)(const Content&, Sheet&),
                const std::vector<std::string>& further = {}) {
  Sheet sheet(write, file, further);
  fill(content, sheet);
  sheet.flush();
}
template <class Content>
std::string sheetText(const char* file, const Content& content, void (*fill)(const Content&, Sheet&)) {
  std::string text;
  writeSheet([&](const std::string&, std::string_view piece) { text += piece; }, file, content, fill);
  return text;
}

// The tables, a file for each kind.
void writeTrialTables(const Analysis& analysis, const TableWriter& write);
void writeConditionTables(const Analysis& analysis, const TableWriter& write);
/// Writes nothing where no trial has a trained field or a rotated cursor.
void writeAdaptationTable(const Analysis& analysis, const TableWriter& write);

}  // namespace reachlab::analysis
