#pragma once
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "analysis/tables.h"

/// The tables of an analysis as they are written.
namespace reachlab::analysis {

/// Text of each, by its file's name.
inline std::map<std::string, std::string> tablesOf(const Analysis& analysis) {
  std::map<std::string, std::string> files;
  writeTables(analysis, [&](const std::string& name, std::string_view piece) { files[name] += piece; });
  return files;
}

using Row = std::map<std::string, std::string>;  // cells by column

inline std::vector<Row> rowsOf(const std::string& csv) {
  std::vector<Row> rows;
  std::vector<std::string> columns;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line + ',');
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (columns.empty()) columns = row;
    else {
      rows.emplace_back();
      for (std::size_t i = 0; i < columns.size(); ++i) rows.back()[columns[i]] = row.at(i);
    }
  }
  return rows;
}

}  // namespace reachlab::analysis
