#include "analysis/tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "analysis/table_columns.h"
#include "tests/analysis/made_analysis.h"

namespace reachlab::analysis {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> tableOf(const Analysis& analysis, const std::string& file) {
  std::string text;
  writeTables(analysis, [&](const std::string& name, std::string_view piece) { text += name == file ? piece : ""; });
  std::vector<Row> rows;
  std::vector<std::string> columns;
  std::istringstream lines(text);
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

/// Numbers as numbers: they are written with as many digits as read back equal.
void expectCells(const Row& row, const Row& expected) {
  for (const auto& [column, cell] : expected) {
    const std::string& given = row.at(column);
    char* end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (cell.empty() || given.empty() || *end != '\0') EXPECT_EQ(given, cell) << column;
    else EXPECT_EQ(std::strtod(given.c_str(), nullptr), value) << column << " is " << given;
  }
}
double numberIn(const Row& row, const std::string& column) { return std::stod(row.at(column)); }

// Columns are named in one table and filled in order: a cell too few or too many would shift all that follow.
TEST(Tables, HaveACellForEachColumn) {
  std::map<std::string, std::string> files;
  writeTables(madeStudy(), [&](const std::string& name, std::string_view piece) { files[name] += piece; });
  EXPECT_EQ(files.size(), 13u);
  for (const auto& [name, text] : files) {
    EXPECT_FALSE(tableColumns(name).empty()) << name;
    std::istringstream lines(text);
    std::ptrdiff_t commas = -1;
    for (std::string line; std::getline(lines, line);) {
      const auto here = std::count(line.begin(), line.end(), ',');
      if (commas < 0) commas = here;
      EXPECT_EQ(here, commas) << name << ": " << line;
    }
  }
}

// Time-scaled to the condition's mean of 1.6 s, and faster or slower by as much.
TEST(Tables, OfProfilesAreScaledToTheMeanDuration) {
  const Analysis analysis = madeStudy();
  const std::vector<Row> rows = tableOf(analysis, "profiles.csv");
  ASSERT_EQ(rows.size(), 3u * 101);
  const Row& row = rows[101 + 25];  // the third trial, of 2.4 s
  expectCells(row, {{"condition", "slow pace"}, {"subject", "A"}, {"session", "02"}, {"run", "3"}, {"trial", "3"}, {"percent", "25"}});
  EXPECT_NEAR(numberIn(row, "time_s"), 0.4, 1e-12);
  EXPECT_NEAR(numberIn(row, "hand_m_per_s"), 1.5 * (30 + 25), 1e-9);
  EXPECT_NEAR(numberIn(row, "object_m_per_s"), 1.5 * (30 + 101 + 25), 1e-9);
  const std::vector<Row> means = tableOf(analysis, "mean_profiles.csv");
  ASSERT_EQ(means.size(), 101u);
  EXPECT_NEAR(numberIn(means[50], "time_s"), 0.8, 1e-12);
  expectCells(means[50], {{"percent", "50"},
                          {"trials", "3"},
                          {"hand_mean_m_per_s", "51"},
                          {"hand_sd_m_per_s", "250"},
                          {"object_mean_m_per_s", "450"},
                          {"object_sd_m_per_s", "650"}});
}

// Time is counted from where the onset rule would find it, 0.12 s after the prediction's beginning.
TEST(Tables, OfPredictionsAreNeitherCutNorStretched) {
  const std::vector<Row> rows = tableOf(madeStudy(), "predictions.csv");
  ASSERT_EQ(rows.size(), 2u * 201);
  expectCells(rows[0], {{"condition", "slow pace"}, {"criterion", "min-crackle"}, {"predicted_duration_s", "2.75"}, {"percent", "0"}});
  EXPECT_NEAR(numberIn(rows[0], "time_s"), -0.12, 1e-12);
  const Row& row = rows[201 + 50];
  expectCells(row, {{"criterion", "min-hand-jerk"}, {"predicted_duration_s", "2.5"}, {"percent", "25"}});
  EXPECT_NEAR(numberIn(row, "time_s"), 0.5 - 0.12, 1e-12);
  EXPECT_NEAR(numberIn(row, "hand_m_per_s"), 0.125, 1e-12);
  EXPECT_NEAR(numberIn(row, "object_m_per_s"), 0.25, 1e-12);
  EXPECT_NEAR(numberIn(rows[401], "time_s"), 1.88, 1e-12);
}

TEST(Tables, OfRankingsHaveIntervalsWhereThereAreSome) {
  const std::vector<Row> rows = tableOf(madeStudy(), "ranking.csv");
  ASSERT_EQ(rows.size(), 4u);
  expectCells(rows[0], {{"signal", "hand"},
                        {"rank", "1"},
                        {"criterion", "min-hand-jerk"},
                        {"epsilon_m_per_s", "0.021"},
                        {"epsilon_low_m_per_s", "0.011"},
                        {"epsilon_high_m_per_s", "0.031"},
                        {"difference_m_per_s", "0"},
                        {"difference_low_m_per_s", ""},
                        {"apart_from_first", ""},
                        {"trials", "3"},
                        {"subjects", "2"}});
  expectCells(rows[1], {{"rank", "2"},
                        {"criterion", "min-crackle"},
                        {"difference_m_per_s", "0.02"},
                        {"difference_low_m_per_s", "0.004"},
                        {"difference_high_m_per_s", "0.036"},
                        {"apart_from_first", "yes"}});
  expectCells(rows[2], {{"signal", "object"}, {"rank", "1"}, {"criterion", "min-crackle"}, {"epsilon_low_m_per_s", ""}});
  expectCells(rows[3], {{"rank", "2"}, {"apart_from_first", "no"}});
}

TEST(Tables, OfFitsSayWhatWasChosen) {
  const Analysis analysis = madeStudy();
  const std::vector<Row> rows = tableOf(analysis, "fits.csv");
  ASSERT_EQ(rows.size(), 3u) << "nothing was fitted to B";
  expectCells(rows[0], {{"condition", "slow pace"},
                        {"subject", "A"},
                        {"criterion", "min-hand-jerk"},
                        {"equivalent", ""},
                        {"ceiling", "0.97"},
                        {"time_law", "one-plan"},
                        {"plan_s", "1.45"},
                        {"hand_mass_kg", ""},
                        {"trials", "2"},
                        {"decided", "1"}});
  EXPECT_NEAR(numberIn(rows[0], "epsilon_fit_m_per_s"), -1.2, 1e-12);
  EXPECT_NEAR(numberIn(rows[0], "r2"), -1.1, 1e-12);
  EXPECT_NEAR(numberIn(rows[0], "score"), -1.3, 1e-12);
  EXPECT_NEAR(numberIn(rows[0], "duration_s"), -1.05, 1e-12);
  expectCells(rows[1], {{"criterion", "min-hand-force"},
                        {"equivalent", "min-com-acceleration"},
                        {"time_law", "anew"},
                        {"plan_s", ""},
                        {"hand_mass_kg", "1.5"},
                        {"decided", "0"}});
  expectCells(rows[2], {{"criterion", "reference"}, {"time_law", ""}, {"hand_mass_kg", ""}});
}

TEST(Tables, OfConclusionsAreOfEachConditionAndOfAll) {
  const std::vector<Row> rows = tableOf(madeStudy(), "conclusions.csv");
  ASSERT_EQ(rows.size(), 5u);
  expectCells(rows[0], {{"condition", "slow pace"},
                        {"unit", "subjects"},
                        {"criterion", "min-hand-jerk"},
                        {"score", "-2.5"},
                        {"score_above_best", "0"},
                        {"p", ""},
                        {"posterior", "0.91"},
                        {"best", "yes"},
                        {"decided", "1"},
                        {"reason", ""},
                        {"level", "0.05"},
                        {"subjects", "2"},
                        {"trials", "31"}});
  expectCells(rows[1], {{"criterion", "min-hand-force"}, {"score_above_best", "1.25"}, {"p", "0.03"}, {"best", "no"}, {"decided", "0"}});
  expectCells(rows[3], {{"condition", "all"},
                        {"unit", "trials"},
                        {"score_above_best", "1"},
                        {"p", "0.04"},
                        {"posterior", ""},
                        {"best", "no"},
                        {"decided", "0"},
                        {"reason", "poor"}});
  expectCells(rows[4], {{"criterion", "reference"}, {"best", "yes"}, {"decided", "0"}});
}

TEST(Tables, OfEffectsGiveNoPForOnePerson) {
  const std::vector<Row> rows = tableOf(madeStudy(), "effects.csv");
  ASSERT_EQ(rows.size(), 4u);
  expectCells(rows[0], {{"effect", "day"},
                        {"condition", "quick"},
                        {"from", "D1"},
                        {"to", "D2"},
                        {"subjects", "2"},
                        {"difference_percent", "21"},
                        {"low_percent", "5"},
                        {"high_percent", "37"},
                        {"p", "0.012"}});
  EXPECT_NEAR(numberIn(rows[0], "odds_ratio"), 2.5, 1e-12);
  EXPECT_NEAR(numberIn(rows[0], "odds_ratio_low"), 1.25, 1e-12);
  EXPECT_NEAR(numberIn(rows[0], "odds_ratio_high"), 5, 1e-12);
  expectCells(rows[1], {{"effect", "condition"},
                        {"condition", ""},
                        {"from", "slow pace"},
                        {"to", "quick"},
                        {"low_percent", ""},
                        {"odds_ratio_low", ""},
                        {"odds_ratio_high", ""},
                        {"p", ""}});
  expectCells(rows[2], {{"effect", "slope"},
                        {"condition", "quick"},
                        {"from", ""},
                        {"subjects", "2"},
                        {"difference_percent", "7.5"},
                        {"low_percent", "-2.5"},
                        {"high_percent", "17.5"},
                        {"odds_ratio", ""},
                        {"p", "0.2"}});
  expectCells(rows[3], {{"subjects", "1"}, {"p", ""}});
}

}  // namespace
}  // namespace reachlab::analysis
