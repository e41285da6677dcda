#include <gtest/gtest.h>

#include "tests/cli/program.h"

using namespace reachlab::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

struct Measured {
  std::string out;
  Json rows;
};
Measured measured(const std::string& arguments) {
  const fs::path file = fs::path(testing::TempDir()) / "rows.json";
  fs::remove(file);
  return {printed("bench " + arguments + " --json " + file.string()), Json::parse(contentOf(file))};
}

TEST(Bench, MeasuresInAProgramOfItsOwnAndKeepsItsContract) {
  const auto [out, rows] = measured("--scene S1 --scene S6 --method auto --quick --rounds 5");
  ASSERT_EQ(rows.size(), 2u);
  for (const Json& row : rows) {
    for (const char* key : {"level", "scene", "method", "step_s", "tolerance", "state_error", "position_error_m", "ns_per_ms", "steps",
                            "rhs_evaluations", "bits"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_LT(row["state_error"].get<double>(), 1e-12);  // the exact step's rounding over 1350 ticks
    EXPECT_GT(row["ns_per_ms"].get<double>(), 0);
  }
  EXPECT_EQ(out.substr(0, out.find('\n')), "level " + rows[0]["level"].get<std::string>());
  EXPECT_TRUE(holds(out, "S6"));
  EXPECT_EQ(reach("bench --scene S99").exitCode, 2);
  EXPECT_EQ(reach("bench --rounds 1").exitCode, 2);
  EXPECT_EQ(reach("bench --scene S1 --quick --rounds 5 --method auto --json /dev/null/rows.json").exitCode, 3);
}

TEST(Bench, FormsOfAConstraintWhosePricesStandTogetherAreTheSameConstraint) {
  const Json rows = measured("--scene constraint-eval").rows;
  ASSERT_EQ(rows.size(), 11u);
  for (const Json& row : rows) {
    EXPECT_LT(row.at("apart_m").get<double>(), 1e-15) << row;
    EXPECT_GT(row.at("ns_per_eval").get<double>(), 0) << row;
  }
}

TEST(Bench, SaysWhereTheMeasuringProgramWasLookedFor) {
  const fs::path folder = fs::path(testing::TempDir()) / "alone";
  fs::create_directories(folder);
  fs::copy_file(REACH_PROGRAM, folder / "reach", fs::copy_options::overwrite_existing);
  const Ended ended = endOf((folder / "reach").string() + " bench --scene S1");
  EXPECT_TRUE(says(ended, 3, (folder / "reachlab-bench").string()));
  EXPECT_TRUE(holds(ended.err, "libexec/reachlab/reachlab-bench"));
}

TEST(Bench, TheProgramThatRecordsPeopleRunsUnderTheSystemsOperatorNew) {
  const auto replaces = [](const std::string& program) { return shell("nm --defined-only " + program + " | grep -w _Znwm").exitCode == 0; };
  EXPECT_FALSE(replaces(REACH_PROGRAM));
  EXPECT_TRUE(replaces(fs::path(REACH_PROGRAM).replace_filename("reachlab-bench").string())) << "the check itself";
}

}  // namespace
