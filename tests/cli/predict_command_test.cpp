// `reach predict` as scripts see it: columns, keys, null rules, exit codes.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "test_paths.h"

namespace reachlab::cli {
namespace {

struct Answer {
  int exit = 0;
  std::string out;
};

Answer reachPredict(const std::string& arguments) {
  Answer run;
  FILE* pipe = popen((std::string(REACH_PROGRAM) + " predict " + arguments + " 2>/dev/null").c_str(), "r");
  if (pipe == nullptr) return {-1, ""};
  std::array<char, 4096> buffer{};
  while (const size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) run.out.append(buffer.data(), n);
  run.exit = WEXITSTATUS(pclose(pipe));
  return run;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(PredictCommand, WritesTheProfilesFromZeroToT) {
  const Answer run = reachPredict("parallel --criterion min-hand-jerk");
  ASSERT_EQ(run.exit, 0);
  const auto lines = linesOf(run.out);
  ASSERT_EQ(lines.size(), 202u);
  EXPECT_EQ(lines[0], "time_s,hand_m,hand_m_per_s,hand_m_per_s2,mass1_m,mass1_m_per_s,mass2_m,mass2_m_per_s");
  EXPECT_EQ(lines[1].substr(0, 2), "0,");
  EXPECT_EQ(lines[201].substr(0, 4), "2.5,");
  for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_NEAR(std::stod(lines[i]), 2.5 / 200 * static_cast<double>(i - 1), 1e-12) << i;
}

TEST(PredictCommand, WritesTheNumbersAsJson) {
  const Answer run = reachPredict("chain-moderate --criterion min-hand-jerk --json");
  ASSERT_EQ(run.exit, 0);
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json.at("criterion"), "min-hand-jerk");
  EXPECT_NEAR(json.at("cost").get<double>(), 6.76284544993, 1e-10);
  EXPECT_NEAR(json.at("duration_s").get<double>(), 1.35, 1e-12);
  EXPECT_NEAR(json.at("distance_m").get<double>(), 0.2, 1e-12);
  for (const char* key :
       {"hand_peak_m_per_s", "hand_peak_s", "object_peak_m_per_s", "hand_jump_m", "hand_jump_m_per_s", "condition", "travel_time_s"})
    EXPECT_TRUE(json.at(key).is_number()) << key;
}

TEST(PredictCommand, SaysNullWhereAPulseOrAParallelObjectLeavesNoNumber) {
  const auto pulse = nlohmann::json::parse(reachPredict("dingwell --criterion min-hand-force --json").out);
  EXPECT_TRUE(pulse.at("hand_jump_m_per_s").is_null());
  EXPECT_GT(pulse.at("hand_jump_m").get<double>(), 0.016);
  EXPECT_TRUE(nlohmann::json::parse(reachPredict("parallel --criterion min-crackle --json").out).at("travel_time_s").is_null());
}

TEST(PredictCommand, SweepsAFamily) {
  const Answer run = reachPredict("dingwell --criterion min-hand-jerk --sweep duration_s=0.5:3:0.5");
  ASSERT_EQ(run.exit, 0);
  const auto lines = linesOf(run.out);
  ASSERT_EQ(lines.size(), 7u);
  EXPECT_EQ(lines[0].substr(0, 29), "duration_s,cost,hand_peak_m_p");
  EXPECT_EQ(lines[6].substr(0, 2), "3,");
}

TEST(PredictCommand, RefusesWithTheAgreedNumbers) {
  EXPECT_EQ(reachPredict("chain-moderate --criterion min-effort").exit, 2);
  EXPECT_EQ(reachPredict("nowhere --criterion min-hand-jerk").exit, 2);
  EXPECT_EQ(reachPredict("chain-moderate --criterion min-hand-jerk --duration 0.02").exit, 4);
  EXPECT_EQ(reachPredict("chain-moderate --criterion min-hand-jerk --sweep nothing=1:2:1").exit, 2);
}

}  // namespace
}  // namespace reachlab::cli
