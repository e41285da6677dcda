#include <gtest/gtest.h>

#include <cmath>

#include "tests/cli/program.h"

using namespace reachlab::test;
using Json = nlohmann::json;

TEST(ConstraintCommand, EvaluatesACurveWithItsDerivatives) {
  const Ended ended = reach("constraint eval line --at 3.141592653589793 --json");
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Json json = Json::parse(ended.out);
  EXPECT_NEAR(json.at("r_m")[0].get<double>(), 0, 1e-16);
  EXPECT_NEAR(json.at("r_phi")[0].get<double>(), 0.2 / (2 * M_PI), 1e-17);
  EXPECT_EQ(json.at("r_phiphi")[0].get<double>(), 0);
}

TEST(ConstraintCommand, EvaluatesASurfaceWithItsDerivatives) {
  const Ended ended = reach("constraint eval torus --at 0.3,0.5 --json");
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const Json json = Json::parse(ended.out);
  for (const char* key : {"at", "r_m", "r_u", "r_v", "r_uu", "r_uv", "r_vv"}) EXPECT_TRUE(json.contains(key)) << key;
}

TEST(ConstraintCommand, ShowsEveryDefinition) {
  const Json rows = Json::parse(reach("list constraints --json").out);
  int curves = 0, surfaces = 0;
  for (const Json& row : rows) {
    if (row.at("name") == "free") continue;
    const Ended ended = reach("constraint show --json " + row.at("name").get<std::string>());
    ASSERT_EQ(ended.exitCode, 0) << row << ended.err;
    const Json json = Json::parse(ended.out);
    for (const char* key : {"name", "kind", "shape", "domain", "periodic", "at_end", "start", "target", "source"})
      EXPECT_TRUE(json.contains(key)) << row << key;
    const std::string kind = json.at("kind");
    EXPECT_TRUE(json.contains(kind)) << row;
    (kind == "curve" ? curves : surfaces) += 1;
  }
  EXPECT_GE(curves, 24);
  EXPECT_GE(surfaces, 20);
}

TEST(ConstraintCommand, RefusesAFormulaThatIsAPoint) {
  const Folder folder;
  const std::string file = folder.write("point.json", R"({"schema_version": 1, "constraint": {"curve": ["1", "2", "3"]},
    "object": {"kind": "point", "masses_kg": [1]}, "coupling": {"stiffness_n_per_m": 600}})");
  const Ended ended = reach("simulate " + file + " --hand none --at 0 --until 0.1");
  EXPECT_TRUE(ended.exitCode == 2 || ended.exitCode == 4) << ended.exitCode << ended.err;
}

TEST(ConstraintCommand, PointsAtTheCharacterOfASyntaxFault) {
  const Folder folder;
  const std::string file = folder.write("bad.json", R"j({"schema_version": 1, "constraint": {"curve": ["cos(phi", "2", "3"]},
    "object": {"kind": "point", "masses_kg": [1]}, "coupling": {"stiffness_n_per_m": 600}})j");
  const Ended ended = reach("validate " + file);
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("expected"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("bad.json:1:"), std::string::npos) << ended.err;
}
