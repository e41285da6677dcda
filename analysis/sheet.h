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

  Sheet& cell(std::string_view text) { return table_.cell(text), *this; }
  Sheet& number(double value) { return table_.number(value), *this; }
  Sheet& whole(long long value) { return table_.whole(value), *this; }
  Sheet& count(std::size_t value) { return whole(static_cast<long long>(value)); }
  /// Both ends, or two empty cells where there is no interval.
  Sheet& bounds(const std::optional<Bounds>& bounds) {
    const bool known = bounds && bounds->finite();
    return number(known ? bounds->low : kNotMeasured).number(known ? bounds->high : kNotMeasured);
  }
  void endRow() {
    constexpr std::size_t kPiece = std::size_t{1} << 20;
    table_.endRow();
    if (table_.text().size() > kPiece) flush();
  }
  void flush() { write_(name_, table_.takeText()); }

 private:
  const TableWriter& write_;
  std::string name_;
  TableText table_{',', ""};
};

// The tables, a file for each kind.
void writeTrialTables(const Analysis& analysis, const TableWriter& write);
void writeConditionTables(const Analysis& analysis, const TableWriter& write);
void writeProgressTables(const Analysis& analysis, const TableWriter& write);
/// Writes nothing where no trial has a trained field or a rotated cursor.
void writeAdaptationTable(const Analysis& analysis, const TableWriter& write);

}  // namespace reachlab::analysis
