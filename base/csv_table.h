#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace reachlab {

/// A table from a text file whose first line names the columns. That line also decides the separator: tab, comma, or semicolon. A cell in quotes
/// may have separators, line breaks and doubled quotes (RFC 4180). Spaces beside a cell, a byte order mark, and empty lines are left out.
struct CsvTable {
  struct Row {
    int line = 0;  // where it begins in the file, from 1
    std::vector<std::string> cells;
  };
  std::string file;
  std::vector<std::string> columns;
  std::vector<Row> rows;

  std::optional<std::size_t> find(const std::string& column) const;
};

/// Throws ResourceError where there is no such file, and FaultError for a row with another number of cells than the header.
CsvTable readCsvTable(const std::string& file);

/// The cell as a finite number, with `.` as its decimal mark in every locale. Throws FaultError with the file and line.
double numberIn(const CsvTable& table, const CsvTable::Row& row, std::size_t column);

}  // namespace reachlab
