#include <gtest/gtest.h>

#include <cmath>

#include "tests/cli/program.h"

using namespace reachlab::test;
using Json = nlohmann::json;

class ConstraintCommand : public InAFolder {};

TEST_F(ConstraintCommand, EvaluatesACurveWithItsDerivatives) {
  const Json json = printedJson("constraint eval line --at 3.141592653589793 --json");
  EXPECT_NEAR(json.at("r_m")[0].get<double>(), 0, 1e-16);
  EXPECT_NEAR(json.at("r_phi")[0].get<double>(), 0.2 / (2 * M_PI), 1e-17);
  EXPECT_EQ(json.at("r_phiphi")[0].get<double>(), 0);
}

TEST_F(ConstraintCommand, ShowsEveryDefinition) {
  int curves = 0, surfaces = 0;
  for (const Json& row : printedJson("list constraints --json")) {
    if (row.at("name") == "free") continue;
    const Json json = printedJson("constraint show --json " + row.at("name").get<std::string>());
    for (const char* key : {"name", "kind", "shape", "domain", "periodic", "at_end", "start", "target", "source"})
      EXPECT_TRUE(json.contains(key)) << row << key;
    const std::string kind = json.at("kind");
    EXPECT_TRUE(json.contains(kind)) << row;
    (kind == "curve" ? curves : surfaces) += 1;
  }
  EXPECT_GE(curves, 24);
  EXPECT_GE(surfaces, 20);
}

TEST_F(ConstraintCommand, PointsAtTheCharacterOfASyntaxFault) {
  const std::string file = folder_.write("bad.json", experimentOn(R"j({"curve": ["cos(phi", "2", "3"]})j"));
  const Ended ended = reach("validate " + file);
  EXPECT_TRUE(says(ended, 2, "expected"));
  EXPECT_TRUE(holds(ended.err, "bad.json:1:"));
}

TEST_F(ConstraintCommand, ValidateRefusesADefinitionThatNobodyCouldUse) {
  const std::string file = folder_.write("log.json", R"j({"schema_version": 1, "name": "log", "kind": "curve",
    "curve": ["phi/10", "log(phi - 0.5)", "0"], "domain": [0, 1], "start": [0.1], "target": [0.9]})j");
  EXPECT_TRUE(says(reach("validate " + file), 2, "pole of log(phi - 0.5)"));
  EXPECT_TRUE(says(reach("constraint check " + file), 2, "pole of log(phi - 0.5)"));
}

// sin(10 u) sin(10 v) …: singular along 40 lines and between them at more points than are listed.
TEST_F(ConstraintCommand, CheckTellsWhatItFoundAndWhereItStoppedLooking) {
  const auto check = [&](const std::string& name, const std::string& kind, const std::string& lines, const std::string& domain) {
    const std::string place = kind == "curve" ? "[0]" : "[0, 0]";
    return reach("constraint check " +
                 folder_.write(name + ".json", R"({"schema_version": 1, "name": ")" + name + R"(", "kind": ")" + kind + R"(", ")" + kind +
                                                   "\": " + lines + R"(, "domain": )" + domain + R"(, "start": )" + place +
                                                   R"(, "target": )" + place + "}"));
  };
  const Ended many = check("many", "surface", R"j(["sin(10*u)*sin(10*v)/10", "sin(10*u)^2/10", "sin(10*v)^2/10"])j", "[[-3, 3], [-3, 3]]");
  EXPECT_EQ(many.exitCode, 0) << many.err;
  for (const char* words : {"edge", "there may be more"}) EXPECT_TRUE(holds(many.out, words));
  const Ended one = check("umbrella", "surface", R"(["u*v/10", "u/10", "v^2/10"])", "[[-1, 1], [-1, 1]]");
  EXPECT_TRUE(holds(one.out, "pinch     u = 0, v = 0"));
  EXPECT_FALSE(holds(one.out, "there may be more"));
  EXPECT_TRUE(holds(one.out, "umbrella.json: fine: surface umbrella"));
  EXPECT_TRUE(holds(check("saddle", "surface", R"(["u/10", "v/10", "u*v/10"])", "[[-1, 1], [-1, 1]]").out, "no degenerate position"));
  EXPECT_TRUE(holds(check("bend", "curve", R"(["phi/10", "phi^2/10", "0"])", "[-1, 1]").out, "no kink, jump, pole, end or cusp"));
  EXPECT_EQ(check("point", "curve", R"(["1", "2", "3"])", "[0, 1]").exitCode, 2);
  EXPECT_TRUE(says(check("hole", "curve", R"j(["1/(phi - 0.3)", "phi", "0"])j", "[0, 1]"), 2, "not finite at phi = 0.3"));
}

TEST_F(ConstraintCommand, RefusesTenThousandCharactersAndParentheses) {
  const std::string open(10000, '('), close(10000, ')');
  std::string sum = "phi";
  while (sum.size() < 10000) sum += "+phi";
  for (const std::string& formula : {open + "phi" + close, open, sum, std::string(10000, '-') + "phi"}) {
    const Ended ended = reach("constraint check " +
                              folder_.write("long.json", R"({"schema_version": 1, "name": "long", "kind": "curve", "curve": [")" + formula +
                                                             R"(", "phi", "0"], "domain": [0, 1], "start": [0], "target": [1]})"));
    EXPECT_TRUE(says(ended, 2, "allowed: 2000"));
  }
}

TEST_F(ConstraintCommand, CodeGivesEveryNumberThatItPromisesAValue) {
  for (const char* name : {"ellipse", "torus"}) {
    const std::string code = printed(std::string("constraint code ") + name);
    const std::size_t first = code.find("  double "), last = code.find(';', first);
    ASSERT_NE(last, std::string::npos) << code;
    std::istringstream members(code.substr(first + 9, last - first - 9));
    int count = 0;
    for (std::string member; std::getline(members >> std::ws, member, ','); ++count)
      EXPECT_TRUE(holds(code, "  out." + member + " = ")) << name << " " << member;
    EXPECT_GE(count, 7);
  }
}

TEST_F(ConstraintCommand, ShowsAPersonNoMoreDigitsThanAreMeant) {
  EXPECT_TRUE(holds(printed("constraint show ellipse"), "reach     from [0] to [3.14159]\n"));
  EXPECT_TRUE(holds(printed("constraint show ellipse --json"), "3.1415926535897931"));
}
