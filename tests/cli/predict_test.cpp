#include <gtest/gtest.h>

#include <cmath>

#include "cli/output/predict_output.h"
#include "tests/cli/program.h"

using namespace reachlab::test;
using Json = nlohmann::json;

namespace {

struct Case {
  const char* arguments;
  double cost, handPeak, handPeakTime, objectPeak;
};
// Published digits (docs/theory/criteria.md, "Numbers to test against"): ten significant figures of J and of the hand's peak, seven of the
// object's.
const Case kCases[] = {
    {"dingwell --criterion min-hand-jerk", 16.5196433594, 0.2096247949, 0.444958, 0.3792369},
    {"dingwell --criterion min-crackle", 68220.8533855, 0.2045467535, 0.675, 0.3645833},
    {"dingwell --criterion min-hand-force-change", 57.8050997194, 0.2168114617, 0.675, 0.2777778},
    {"chain-moderate --criterion min-hand-jerk", 6.76284544993, 0.2881958938, 0.675, 0.4106285},
    {"parallel --criterion min-hand-jerk", 0.378717793518, 0.1315335137, 1.18458, 0.1419976},
};

}  // namespace

TEST(Predict, GivesThePublishedNumbers) {
  for (const Case& c : kCases) {
    const Json json = printedJson(std::string("predict ") + c.arguments + " --json");
    EXPECT_NEAR(json.at("cost").get<double>() / c.cost, 1, 1e-11) << c.arguments;
    EXPECT_NEAR(json.at("hand_peak_m_per_s").get<double>(), c.handPeak, 1e-10) << c.arguments;
    EXPECT_NEAR(json.at("hand_peak_s").get<double>(), c.handPeakTime, 1e-5) << c.arguments;
    EXPECT_NEAR(json.at("object_peak_m_per_s").get<double>(), c.objectPeak, 1e-7) << c.arguments;
    for (const char* key : {"criterion", "hand_jump_m", "hand_jump_m_per_s", "condition", "travel_time_s"})
      EXPECT_TRUE(json.contains(key)) << key;
  }
}

TEST(Predict, WritesEquallySpacedRowsFromRestToRest) {
  const Table table = parseCsv(printed("predict parallel --criterion min-hand-jerk"));
  EXPECT_EQ(table.header, split("time_s,hand_m,hand_m_per_s,hand_m_per_s2,mass1_m,mass1_m_per_s,mass2_m,mass2_m_per_s", ','));
  ASSERT_EQ(table.rows.size(), 201u);
  for (std::size_t i = 0; i < 201; ++i) EXPECT_NEAR(table.at(i, "time_s"), 2.5 / 200 * static_cast<double>(i), 1e-12) << i;
  EXPECT_NEAR(table.at(0, "hand_m"), 0, 1e-12);
  EXPECT_NEAR(table.at(200, "hand_m"), 0.2, 1e-12);
  EXPECT_NEAR(table.at(200, "mass2_m"), 0.2, 1e-12);
}

TEST(Predict, SaysNullWhereAPulseOrAParallelObjectLeavesNoNumber) {
  const auto numbers = [](const std::string& what) { return printedJson("predict " + what + " --json"); };
  const Json pulse = numbers("dingwell --criterion min-hand-force");
  EXPECT_TRUE(pulse.at("hand_jump_m_per_s").is_null());
  EXPECT_GT(pulse.at("hand_jump_m").get<double>(), 0.016);
  EXPECT_TRUE(numbers("parallel --criterion min-hand-jerk").at("travel_time_s").is_null());
  EXPECT_NEAR(numbers("chain-fast --criterion min-hand-jerk").at("travel_time_s").get<double>(), 2 * 5 * std::sqrt(0.6 / 600), 1e-12);
}

TEST(Predict, SaysHowLongItComputed) {
  EXPECT_TRUE(
      std::regex_search(reach("predict dingwell --criterion min-hand-jerk --json --time").err, std::regex("computed in [1-9][0-9]* us")));
}

TEST(Predict, SweepsAFamily) {
  const std::string family = printed("predict dingwell --criterion min-hand-jerk --sweep duration_s=0.5:3:0.5");
  EXPECT_TRUE(family.starts_with("duration_s,cost,hand_peak_m_p"));
  const Table table = parseCsv(family);
  ASSERT_EQ(table.rows.size(), 6u);
  EXPECT_EQ(table.at(5, "duration_s"), 3);
  const auto drawn = reachlab::cli::drawSweep({"duration_s", 1, 2, 0.5}, {}, reachlab::predict::Criterion::MinHandJerk);
  EXPECT_EQ(drawn.panels.at(0).x.label, "Movement time (s)");
}

TEST(Predict, RefusesWithTheAgreedNumbers) {
  EXPECT_EQ(reach("predict chain-moderate --criterion min-effort").exitCode, 2);
  EXPECT_EQ(reach("predict nowhere --criterion min-hand-jerk").exitCode, 2);
  EXPECT_EQ(reach("predict chain-moderate --criterion min-hand-jerk --duration 0.02").exitCode, 4);
  EXPECT_EQ(reach("predict chain-moderate --criterion min-hand-jerk --sweep nothing=1:2:1").exitCode, 2);
  EXPECT_TRUE(says(reach("predict torus --criterion min-crackle --sweep duration_s=1:2:1"), 4, "none of the 2 values of duration_s"));
}

TEST(Adaptation, WarnsOfResponsesOfTheOppositeSign) {
  const TemporaryFolder folder;
  std::string series = "perturbation,response\n";
  for (int i = 0; i < 60; ++i) series += "1," + std::to_string(std::exp(-0.1 * i) - 1) + "\n";
  EXPECT_TRUE(says(reach("adaptation " + folder.write("series.csv", series) + " --resamples 100"), 0, "Check their sign"));
}

TEST(Adaptation, WarnsOfABaselineThatIsNotZero) {
  const TemporaryFolder folder;
  std::string series = "perturbation,response\n";
  for (int i = 0; i < 80; ++i)
    series += (i < 20 ? "0," : "1,") + std::to_string(0.3 + 0.01 * (i % 3) + (i < 20 ? 0 : 1 - std::exp(-0.1 * (i - 20)))) + "\n";
  EXPECT_TRUE(says(reach("adaptation " + folder.write("series.csv", series) + " --resamples 100"), 0, "Subtract that mean"));
}
