#include "analysis/tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "tests/analysis/made_study.h"

namespace reachlab::analysis {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> tableOf(const StudyResult& study, const std::string& file) {
  std::string text;
  writeTables(study, [&](const std::string& name, std::string_view piece) { text += name == file ? piece : ""; });
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

TEST(Tables, OfTrialsSayOfEachWhatWasMeasured) {
  const StudyResult study = madeStudy();
  const std::vector<Row> rows = tableOf(study, "trials.csv");
  ASSERT_EQ(rows.size(), 4u);
  expectCells(rows[0], {{"subject", "A"},
                        {"session", "01"},
                        {"run", "2"},
                        {"block", "41"},
                        {"trial", "1"},
                        {"day", "1"},
                        {"condition", "slow pace"},
                        {"phase", "recorded"},
                        {"outcome", "success"},
                        {"reason", ""},
                        {"mass", "0"},
                        {"by", "0"},
                        {"used", "1"},
                        {"exclusion", ""},
                        {"before_go", "0"},
                        {"other_way", "0"}});
  expectCells(rows[1], {{"phase", "practice"},
                        {"outcome", "failure"},
                        {"reason", "velocity"},
                        {"mass", "2"},
                        {"by", "0.015"},
                        {"used", "0"},
                        {"exclusion", "practice"},
                        {"before_go", "1"},
                        {"other_way", "1"},
                        {"sparc", ""},
                        {"epsilon_hand_min_hand_jerk_m_per_s", ""}});
  const char* measures[] = {"reaction_time_s",
                            "onset_s",
                            "offset_s",
                            "duration_s",
                            "movement_time_s",
                            "peak_speed_m_per_s",
                            "time_to_peak_s",
                            "time_to_peak_percent",
                            "symmetry_ratio",
                            "path_length_m",
                            "speed_peaks",
                            "hand_endpoint_error_m",
                            "object_endpoint_error_m",
                            "hand_overshoot_m",
                            "object_overshoot_m",
                            "sparc",
                            "ldlj",
                            "peak_force_n",
                            "mean_force_n"};
  for (int i = 0; i < 19; ++i)
    EXPECT_EQ(numberIn(rows[2], measures[i]), i == 3 ? study.trials[2].measures.duration : 30 + 0.0625 * (i + 1)) << measures[i];
  // (3) was predicted first, but columns stand in the paper's order.
  EXPECT_EQ(numberIn(rows[0], "epsilon_hand_min_crackle_m_per_s"), 10.1);
  EXPECT_EQ(numberIn(rows[0], "epsilon_hand_min_hand_jerk_m_per_s"), 10.2);
  EXPECT_EQ(numberIn(rows[0], "epsilon_object_min_crackle_m_per_s"), 10.3);
  EXPECT_EQ(numberIn(rows[0], "epsilon_object_min_hand_jerk_m_per_s"), 10.4);
  std::string header;
  writeTables(study, [&](const std::string& name, std::string_view piece) { header += name == "trials.csv" ? piece : ""; });
  EXPECT_LT(header.find("epsilon_hand_min_hand_jerk"), header.find("epsilon_hand_min_crackle"));
  EXPECT_LT(header.find("epsilon_hand_min_crackle"), header.find("epsilon_object_min_hand_jerk"));
}

// Time-scaled to the condition's mean of 1.6 s, and faster or slower by as much.
TEST(Tables, OfProfilesAreScaledToTheMeanDuration) {
  const StudyResult study = madeStudy();
  const std::vector<Row> rows = tableOf(study, "profiles.csv");
  ASSERT_EQ(rows.size(), 3u * 101);
  const Row& row = rows[101 + 25];  // the third trial, of 2.4 s
  expectCells(row, {{"condition", "slow pace"}, {"subject", "A"}, {"session", "02"}, {"run", "3"}, {"trial", "3"}, {"percent", "25"}});
  EXPECT_NEAR(numberIn(row, "time_s"), 0.4, 1e-12);
  EXPECT_NEAR(numberIn(row, "hand_m_per_s"), 1.5 * (30 + 25), 1e-9);
  EXPECT_NEAR(numberIn(row, "object_m_per_s"), 1.5 * (30 + 101 + 25), 1e-9);
  const std::vector<Row> means = tableOf(study, "mean_profiles.csv");
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

TEST(Tables, OfSeriesHaveARowForEachSignalAndCriterion) {
  const std::vector<Row> rows = tableOf(madeStudy(), "series.csv");
  ASSERT_EQ(rows.size(), 8u);
  expectCells(rows[1], {{"subject", "A"},
                        {"session", "01"},
                        {"run", "2"},
                        {"block", "41"},
                        {"day", "1"},
                        {"condition", "slow pace"},
                        {"signal", "hand"},
                        {"criterion", "min-hand-jerk"},
                        {"epsilon_m_per_s", "0.25"},
                        {"trials", "1"}});
  expectCells(rows[6],
              {{"subject", "B"}, {"signal", "object"}, {"criterion", "min-crackle"}, {"epsilon_m_per_s", "0.85"}, {"trials", "2"}});
}

TEST(Tables, OfFitsSayWhatWasChosen) {
  const StudyResult study = madeStudy();
  const std::vector<Row> rows = tableOf(study, "fits.csv");
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

TEST(Tables, OfFittedTrialsLeaveOutWhatWasNotUsed) {
  const std::vector<Row> rows = tableOf(madeStudy(), "fit_trials.csv");
  ASSERT_EQ(rows.size(), 6u) << "two trials, three candidates";
  expectCells(rows[3], {{"condition", "slow pace"},
                        {"subject", "A"},
                        {"session", "02"},
                        {"run", "3"},
                        {"trial", "3"},
                        {"fold", "1"},
                        {"criterion", "min-hand-jerk"}});
  EXPECT_NEAR(numberIn(rows[3], "onset_s"), -2 + 0.301, 1e-12);
  EXPECT_NEAR(numberIn(rows[3], "duration_s"), -2 + 0.401, 1e-12);
  EXPECT_NEAR(numberIn(rows[3], "amplitude_m_per_s"), -2 + 0.501, 1e-12);
  EXPECT_NEAR(numberIn(rows[3], "epsilon_fit_m_per_s"), -2 + 0.201, 1e-12);
  EXPECT_NEAR(numberIn(rows[3], "r2"), 1 - (-2 + 0.601) / 8, 1e-12);
  EXPECT_NEAR(numberIn(rows[3], "score"), -2 + 0.101, 1e-12);
  expectCells(rows[5], {{"criterion", "reference"}, {"onset_s", ""}, {"duration_s", ""}, {"amplitude_m_per_s", ""}, {"r2", ""}});
  EXPECT_NEAR(numberIn(rows[5], "score"), -1 + 0.101, 1e-12);
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

TEST(Tables, OfSuccessAndLearningAreInPercent) {
  const StudyResult study = madeStudy();
  const std::vector<Row> success = tableOf(study, "success_table.csv"), learning = tableOf(study, "learning.csv");
  expectCells(success.at(1),
              {{"subject", "B"}, {"day", "2"}, {"condition", "quick"}, {"successes", "1"}, {"trials", "4"}, {"success_percent", "25"}});
  EXPECT_NEAR(numberIn(success[0], "success_percent"), 37.5, 1e-12);
  EXPECT_NEAR(numberIn(success[0], "low_percent"), 8.5, 1e-12);
  EXPECT_NEAR(numberIn(success[0], "high_percent"), 75.5, 1e-12);
  expectCells(learning.at(1), {{"subject", "A"},
                               {"session", "02"},
                               {"condition", "slow pace"},
                               {"first_trial", "11"},
                               {"last_trial", "14"},
                               {"successes", "3"},
                               {"trials", "4"},
                               {"success_percent", "75"}});
  EXPECT_NEAR(numberIn(learning[1], "low_percent"), 20, 1e-12);
  EXPECT_NEAR(numberIn(learning[1], "high_percent"), 99, 1e-12);
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
  expectCells(rows[1],
              {{"effect", "condition"}, {"condition", ""}, {"from", "slow pace"}, {"to", "quick"}, {"low_percent", ""}, {"p", ""}});
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

TEST(Tables, OfConditionsSayWhatCountedAndByWhichOptions) {
  StudyResult study = madeStudy();
  study.options.handDamping = 0.5;
  study.options.measure.cutoff = 8;
  study.options.measure.onset.percent = 4;
  study.options.measure.onset.speed = 0.03;
  std::vector<Row> rows = tableOf(study, "conditions.csv");
  ASSERT_EQ(rows.size(), 2u);
  expectCells(rows[0], {{"condition", "slow pace"},
                        {"experiment", "synthetic"},
                        {"task_duration_s", "2.25"},
                        {"success", "11"},
                        {"failure", "12"},
                        {"aborted", "13"},
                        {"interrupted", "14"},
                        {"practice", "15"},
                        {"catch", "16"},
                        {"invalid_timing", "3"},
                        {"before_go", "17"},
                        {"other_way", "18"},
                        {"used", "3"},
                        {"used_outcome", "success"},
                        {"mean_duration_s", "1.6"},
                        {"sd_duration_s", "0.06"},
                        {"mean_movement_time_s", "1.7"},
                        {"sd_movement_time_s", "0.07"},
                        {"least_movement_time_s", "1.1"},
                        {"largest_movement_time_s", "1.9"},
                        {"onset_rule", "percent"},
                        {"onset_percent", "4"},
                        {"onset_speed_m_per_s", "0.03"},
                        {"cutoff_hz", "8"},
                        {"hand_mass_kg", "0"},
                        {"hand_masses_tried_kg", "0;1.5"},
                        {"hand_damping_n_s_per_m", "0.5"}});
  expectCells(rows[1],
              {{"used_outcome", ""}, {"least_movement_time_s", ""}, {"largest_movement_time_s", ""}, {"hand_masses_tried_kg", ""}});
  study.results[0].onlyFailures = true;
  study.options.handMass = 0.7;
  rows = tableOf(study, "conditions.csv");
  expectCells(rows[0], {{"used_outcome", "failure"}, {"hand_mass_kg", "0.7"}});
}

TEST(Tables, NameCriteriaAsThePaperNumbersThem) {
  const char* names[] = {"(1) ", "(2) ", "(3) ", "(4) ", "(5) ", "(6) ", "(3h) "};
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    const auto criterion = static_cast<predict::Criterion>(i);
    EXPECT_EQ(numberedName(criterion), names[i] + std::string(predict::nameOf(criterion)));
  }
  EXPECT_EQ(columnOf(predict::Criterion::MinHandForceChange), "min_hand_force_change");
  EXPECT_EQ(nameOfCandidate({}), "reference");
  const FitRow row;
  EXPECT_TRUE(row.epsilon == 0 && row.r2 == 0 && row.score == 0 && row.ceiling == 0 && row.duration == 0 && row.trials == 0 &&
              !row.decided);
}

}  // namespace
}  // namespace reachlab::analysis
