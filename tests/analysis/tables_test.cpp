#include "analysis/tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/table_columns.h"
#include "tests/analysis/made_analysis.h"
#include "tests/analysis/written_tables.h"

namespace reachlab::analysis {
namespace {

/// "column=cell|column=cell"; numbers as numbers: they are written with as many digits as read back equal.
void expectCells(const Row& row, const std::string& expected) {
  std::istringstream cells(expected);
  for (std::string column, cell; std::getline(cells, column, '=') && (std::getline(cells, cell, '|') || true);) {
    const std::string& given = row.at(column);
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || given.empty() || *end != '\0') EXPECT_EQ(given, cell) << column;
    else EXPECT_EQ(std::strtod(given.c_str(), nullptr), value) << column << " is " << given;
  }
}
double numberIn(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

// Columns are named in one table and filled in order: a cell too few or too many would shift all that follow.
TEST(Tables, HaveACellAndASentenceForEachColumn) {
  const std::map<std::string, std::string> files = tablesOf(madeStudy());
  EXPECT_EQ(files.size(), 14u);
  for (const auto& [name, text] : files) {
    const auto dictionary = nlohmann::json::parse(record::columnDictionary(text, tableColumns(name)));
    EXPECT_FALSE(dictionary.empty()) << name;
    for (const auto& [column, entry] : dictionary.items()) EXPECT_NE(entry.at("Description"), "") << name << ": " << column;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      EXPECT_EQ(std::count(line.begin(), line.end(), ',') + 1, static_cast<std::ptrdiff_t>(dictionary.size())) << name << ": " << line;
  }
}

TEST(Tables, OfEffectsGiveNoPForOnePerson) {
  const std::vector<Row> rows = rowsOf(tablesOf(madeStudy())["effects.csv"]);
  ASSERT_EQ(rows.size(), 4u);
  expectCells(rows[0], "effect=day|condition=quick|from=D1|to=D2|subjects=2|difference_percent=21|low_percent=5|high_percent=37|p=0.012");
  EXPECT_NEAR(numberIn(rows[0], "odds_ratio"), 2.5, 1e-12);
  EXPECT_NEAR(numberIn(rows[0], "odds_ratio_low"), 1.25, 1e-12);
  EXPECT_NEAR(numberIn(rows[0], "odds_ratio_high"), 5, 1e-12);
  expectCells(rows[1], "effect=condition|condition=|from=slow pace|to=quick|low_percent=|odds_ratio_low=|odds_ratio_high=|p=");
  expectCells(rows[2],
              "effect=slope|condition=quick|from=|subjects=2|difference_percent=7.5|low_percent=-2.5|high_percent=17.5|odds_ratio=|p=0.2");
  expectCells(rows[3], "subjects=1|p=");
}

}  // namespace
}  // namespace reachlab::analysis
