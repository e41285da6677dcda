#include "constraints/catalogue/generated_catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "base/fault.h"
#include "constraints/regularity/analysis.h"
#include "tests/constraints/made_constraints.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

/// What a definition may hold, and the words that refuse it.
namespace reachlab::constraints {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

const std::string kArcDefinition = R"j({"schema_version": 1, "name": "own-arc", "kind": "curve",
"curve": ["a_m*cos(phi)", "a_m*sin(n*phi)", "0"],
"shape": {"a_m": {"default": 0.2, "min": 0.1, "max": 0.5, "unit": "m", "meaning": "size"}, "n": {"default": 2, "min": 1, "max": 4, "unit": "1", "meaning": "waves", "whole": true}},
"domain": [-1, "n*pi"], "periodic": false, "at_end": "bounce",
"start": ["pi/4"], "target": [2], "sentence": "An arc.", "source": "by hand"})j";
const std::string kTubeDefinition = R"j({"schema_version": 1, "name": "own-tube", "kind": "surface",
"surface": ["0.1*cos(u)", "v", "0.1*sin(u)"],
"domain": [[0, "2*pi"], [-1, null]], "periodic": [true, false], "at_end": ["stop", "bounce"],
"start": [7, 0.5], "target": [1, 2], "sentence": "A tube.", "source": "by hand"})j";

std::string refusalOfDefinition(const std::string& text) {
  return refusalOf([&] { (void)parseDefinition(text, "d"); });
}
std::string curveWith(const std::string& from, const std::string& to) { return refusalOfDefinition(replaced(kArcDefinition, from, to)); }
std::string surfaceWith(const std::string& from, const std::string& to) { return refusalOfDefinition(replaced(kTubeDefinition, from, to)); }

TEST(DefinitionFile, IsReadAsItStands) {
  const Definition curve = parseDefinition(kArcDefinition, "d");
  EXPECT_EQ(curve.name, "own-arc");
  EXPECT_EQ(curve.kind, ConstraintKind::Curve);
  EXPECT_EQ(curve.coordinates[1], "a_m*sin(n*phi)");
  ASSERT_EQ(curve.shape.size(), 2u);
  EXPECT_EQ(curve.shape[0].name + curve.shape[0].unit + curve.shape[0].meaning, "a_mmsize");
  EXPECT_EQ(curve.shape[0].defaultValue, 0.2);
  EXPECT_EQ(curve.shape[0].min, 0.1);
  EXPECT_EQ(curve.shape[0].max, 0.5);
  EXPECT_FALSE(curve.shape[0].whole);
  EXPECT_TRUE(curve.shape[1].whole);
  EXPECT_EQ(curve.domain[0].lo + " " + curve.domain[0].hi, "-1 n*pi");
  EXPECT_FALSE(curve.domain[0].periodic);
  EXPECT_EQ(curve.domain[0].atEnd, AtEnd::Bounce);
  EXPECT_EQ(curve.start, std::vector<double>{kPi / 4});
  EXPECT_EQ(curve.target, std::vector<double>{2});
  EXPECT_EQ(curve.sentence + curve.source, "An arc.by hand");
  const Definition surface = parseDefinition(kTubeDefinition, "d");
  EXPECT_EQ(surface.kind, ConstraintKind::Surface);
  EXPECT_TRUE(surface.domain[0].periodic);
  EXPECT_FALSE(surface.domain[1].periodic);
  EXPECT_EQ(surface.domain[0].atEnd, AtEnd::Stop);
  EXPECT_EQ(surface.domain[1].atEnd, AtEnd::Bounce);
  EXPECT_EQ(surface.domain[1].hi, "");
  EXPECT_EQ(surface.start, (std::vector<double>{7, 0.5})) << "beyond the range of a parameter that goes round";
  for (const std::string& text : {kArcDefinition, kTubeDefinition}) {
    const Definition definition = parseDefinition(text, "d");
    EXPECT_EQ(toJson(parseDefinition(toJson(definition), "again")), toJson(definition));
  }
}

TEST(DefinitionFile, OneValueIsThatOfBothParameters) {
  const std::string both = replaced(replaced(kTubeDefinition, "[true, false]", "false"), "[\"stop\", \"bounce\"]", "\"bounce\"");
  const Definition surface = parseDefinition(replaced(both, "[7, 0.5]", "[1, 0.5]"), "d");
  for (const DomainText& domain : surface.domain) {
    EXPECT_FALSE(domain.periodic);
    EXPECT_EQ(domain.atEnd, AtEnd::Bounce);
  }
  const Definition endless = parseDefinition(replaced(kArcDefinition, "[-1, \"n*pi\"]", "null"), "d");
  EXPECT_EQ(endless.domain[0].lo + endless.domain[0].hi, "");
  EXPECT_EQ(domainOf(endless, defaultsOf(endless))[0].lo, -std::numeric_limits<double>::infinity());
  const Definition silent = parseDefinition(replaced(kArcDefinition, "\"periodic\": false, \"at_end\": \"bounce\",", ""), "d");
  EXPECT_EQ(silent.domain[0].atEnd, AtEnd::Stop);
  EXPECT_FALSE(silent.domain[0].periodic);
}

TEST(DefinitionFile, IsRefusedInWords) {
  EXPECT_EQ(refusalOfDefinition("[1]"), "d:1:1: file: is an array; allowed: an object { … }");
  EXPECT_EQ(curveWith("\"schema_version\": 1", "\"schema_version\": 2"),
            "d:1:20: schema_version: is 2; allowed: 1, the version that this program reads");
  EXPECT_EQ(curveWith("\"name\": \"own-arc\", ", ""), "d:1:1: name: is missing; allowed: the definition's name");
  EXPECT_TRUE(holds(curveWith("\"domain\": [-1,", "\"domain\": [\"\","), "domain[0]: is empty"));
  EXPECT_EQ(curveWith("\"kind\": \"curve\",", ""), "d:1:1: kind: is missing; allowed: curve or surface");
  EXPECT_EQ(curveWith("\"curve\": [\"a_m*cos(phi)\", \"a_m*sin(n*phi)\", \"0\"],", ""),
            "d:1:1: curve: is missing; allowed: three formulas, one a coordinate");
  EXPECT_EQ(curveWith("\"shape\"", "\"surface\": [\"u\", \"v\", \"0\"], \"shape\""),
            "d:1:1: surface: stands beside curve; allowed: one of the two");
  EXPECT_EQ(curveWith("[-1, \"n*pi\"]", "[-1]"), "d:4:11: domain: is not a range; allowed: [lo, hi], null for no end");
  EXPECT_EQ(curveWith("[-1, \"n*pi\"]", "5"), "d:4:11: domain: is not a range; allowed: [lo, hi], null for no end");
  EXPECT_EQ(curveWith("[-1, \"n*pi\"]", "[true, 1]"),
            "d:4:12: domain[0]: is a truth value; allowed: a number, or an expression such as \"2*pi\"");
  EXPECT_EQ(curveWith("[-1, \"n*pi\"]", "[1, {}]"),
            "d:4:15: domain[1]: is an object; allowed: a number, or an expression such as \"2*pi\"");
  EXPECT_EQ(curveWith("[-1, \"n*pi\"]", "[3, 1]"),
            "d:4:11: domain: runs from 3 to 1; allowed: lo < hi\n"
            "d:5:11: start[0]: is 0.7853981633974483; allowed: 3 to 1\n"
            "d:5:31: target[0]: is 2; allowed: 3 to 1");
  EXPECT_EQ(curveWith("\"n*pi\"", "\"n*\""),
            "d:4:19: domain[1]: unexpected end of the formula; expected a number, a name, a function or '('");
  EXPECT_EQ(curveWith("\"n*pi\"", "\"1/0\""), "d:4:16: domain[1]: is not finite; allowed: a finite number");
  EXPECT_EQ(curveWith("\"periodic\": false", "\"periodic\": 0"), "d:4:37: periodic: is a number; allowed: true or false");
  EXPECT_EQ(curveWith("\"bounce\"", "\"jump\""), "d:4:54: at_end: is neither; allowed: stop or bounce");
  EXPECT_EQ(curveWith("\"bounce\"", "7"), "d:4:54: at_end: is neither; allowed: stop or bounce");
  EXPECT_EQ(curveWith("[-1, \"n*pi\"], \"periodic\": false", "[-1, null], \"periodic\": true"),
            "d:4:35: periodic: is true without a range; allowed: a domain with two ends");
  EXPECT_EQ(curveWith("[\"pi/4\"]", "[1, 2]"), "d:5:10: start: is no place; allowed: [phi]");
  EXPECT_EQ(curveWith("[\"pi/4\"]", "1"), "d:5:10: start: is no place; allowed: [phi]");
  EXPECT_EQ(curveWith("\"target\": [2]", "\"target\": [null]"),
            "d:5:31: target[0]: is null; allowed: a number, or an expression such as \"2*pi\"");
  EXPECT_EQ(curveWith("\"target\": [2]", "\"target\": [6.5]"), "d:5:31: target[0]: is 6.5; allowed: -1 to 6.283185307179586");
  EXPECT_TRUE(holds(curveWith("\"pi/4\"", "\"pj/4\""), "d:5:12: start[0]: unknown name 'pj'"));
  for (const char* end : {"[-1]", "[\"2*pi\"]"}) EXPECT_EQ(curveWith("[2]", end), "") << end;
  EXPECT_EQ(refusalOfDefinition(replaced(replaced(kArcDefinition, "\"periodic\": false", "\"periodic\": true"), "[2]", "[7]")), "");
  EXPECT_EQ(curveWith("\"default\": 0.2", "\"default\": 0.6"),
            "d:3:18: shape.a_m: default 0.6 is not within min 0.1 and max 0.5; allowed: min <= default <= max");
  EXPECT_EQ(curveWith("\"min\": 0.1, ", ""), "d:3:18: shape.a_m.min: is missing; allowed: any finite number");
  EXPECT_EQ(curveWith("\"unit\": \"m\"", "\"units\": \"m\"").substr(0, 66),
            "d:3:59: shape.a_m.units: is not known here; did you mean unit?; al");
  EXPECT_EQ(curveWith("own-arc", "Own"),
            "d:1:31: name: is no name of a definition; allowed: lower-case letters, digits and '-', at most 60, not free");
  EXPECT_EQ(curveWith("\"sentence\"", "\"sentense\"").substr(0, 55), "d:5:35: sentense: is not known here; did you mean sente");
}

TEST(DefinitionFile, OfASurfaceIsRefusedInWords) {
  EXPECT_EQ(surfaceWith("[[0, \"2*pi\"], [-1, null]]", "[[0, 1]]"),
            "d:3:11: domain: is not two ranges; allowed: [[lo, hi], [lo, hi]], null for a parameter without ends");
  EXPECT_EQ(surfaceWith("[[0, \"2*pi\"], [-1, null]]", "[[0, 7], [1]]"),
            "d:3:20: domain[1]: is not a range; allowed: [lo, hi], null for no end");
  EXPECT_EQ(surfaceWith("[true, false]", "[true]"), "d:3:50: periodic: has 1 values; allowed: one, or 2");
  EXPECT_EQ(surfaceWith("[true, false]", "[true, 1]"), "d:3:57: periodic[1]: is a number; allowed: true or false");
  EXPECT_EQ(surfaceWith("[true, false]", "[true, true]"), "d:3:57: periodic[1]: is true without a range; allowed: a domain with two ends");
  EXPECT_EQ(surfaceWith("[7, 0.5]", "[7]"), "d:4:10: start: is no place; allowed: [u, v]");
  EXPECT_EQ(surfaceWith("[7, 0.5]", "[7, -2]"), "d:4:14: start[1]: is -2; allowed: -1 to inf");
  EXPECT_EQ(surfaceWith("[-1, null]", "[2, -1]").substr(0, 51), "d:3:25: domain[1]: runs from 2 to -1; allowed: lo <");
  EXPECT_EQ(surfaceWith("[-1, null]", "null"), "");
}

TEST(DefinitionNames, AreOfLowerCaseLettersDigitsAndDashes) {
  Definition definition = parseDefinition(kArcDefinition, "d");
  const auto fine = [&](const std::string& name) {
    definition.name = name;
    return problems(definition).empty();
  };
  for (const std::string& name : {std::string("a"), std::string("z9-0"), std::string(60, 'a')}) EXPECT_TRUE(fine(name)) << name;
  for (const std::string& name :
       {std::string(), std::string("free"), std::string("-a"), std::string("A"), std::string("a_b"), std::string("a.b"), std::string("{"),
        std::string("`"), std::string("/"), std::string(":"), std::string(61, 'a')})
    EXPECT_FALSE(fine(name)) << name;
}

TEST(Shape, IsGivenByNameAndHeldWithinItsRange) {
  const Definition definition = parseDefinition(kArcDefinition, "d");
  EXPECT_EQ(shapeOf(definition, {}, "c")[0], 0.2);
  EXPECT_EQ(shapeOf(definition, {{"n", 3}}, "c")[1], 3);
  EXPECT_EQ(shapeOf(definition, {{"a_m", 0.1}}, "c")[0], 0.1);
  EXPECT_EQ(shapeOf(definition, {{"a_m", 0.5}}, "c")[0], 0.5);
  const auto refused = [&](const std::map<std::string, double>& shape, const Definition& of) -> std::string {
    return refusalOf([&] { (void)makeConstraint(of, shape, "c"); });
  };
  EXPECT_EQ(refused({{"a_m", 0.6}}, definition), "c.shape.a_m: is 0.6; allowed: 0.1 to 0.5 m");
  EXPECT_EQ(refused({{"a_m", 0.05}}, definition), "c.shape.a_m: is 0.05; allowed: 0.1 to 0.5 m");
  EXPECT_EQ(refused({{"n", 1.5}}, definition), "c.shape.n: is 1.5; allowed: a whole number, 1 to 4");
  EXPECT_EQ(refused({{"b_m", 1}}, definition), "c.shape.b_m: own-arc has no such parameter; did you mean a_m?; allowed: a_m or n");
  EXPECT_EQ(refused({{"whatever", 1}}, parseDefinition(kTubeDefinition, "d")),
            "c.shape.whatever: own-tube has no such parameter; allowed: none");
}

TEST(UserDefinitions, AreFoundInTheFolderThatTheEnvironmentNames) {
  std::map<std::string, std::optional<std::string>> before;
  for (const char* name : {"REACHLAB_CONSTRAINTS", "XDG_DATA_HOME", "HOME"}) {
    const char* value = std::getenv(name);
    before[name] = value == nullptr ? std::nullopt : std::optional<std::string>(value);
  }
  ::setenv("REACHLAB_CONSTRAINTS", "/own", 1);
  ::setenv("XDG_DATA_HOME", "/data", 1);
  ::setenv("HOME", "/home/me", 1);
  EXPECT_EQ(userDefinitionFolder(), "/own");
  ::unsetenv("REACHLAB_CONSTRAINTS");
  EXPECT_EQ(userDefinitionFolder(), "/data/reachlab/constraints");
  ::setenv("XDG_DATA_HOME", "", 1);
  EXPECT_EQ(userDefinitionFolder(), "/home/me/.local/share/reachlab/constraints");

  const TemporaryFolder folder;
  std::vector<Fault> faults;
  EXPECT_TRUE(readDefinitionFolder(folder / "none", faults).empty()) << "there is none";
  ::setenv("REACHLAB_CONSTRAINTS", folder.path().c_str(), 1);
  EXPECT_EQ(findDefinition("torus", "c").name, "torus");
  folder.write("torus.json", kTubeDefinition);
  EXPECT_TRUE(holds(refusalOf<FaultError>([] { (void)findDefinition("torus", "c"); }), folder / "torus.json"))
      << "nobody is left to guess which of the two is meant";
  std::filesystem::remove(folder / "torus.json");
  folder.write("own-tube.json", kTubeDefinition);
  folder.write("own-arc.json", kArcDefinition);
  folder.write("read.me", "no definition");
  EXPECT_TRUE(faults.empty());
  folder.write("broken.json", "{");
  folder.write("other-name.json", kArcDefinition);
  const std::vector<Definition> all = readDefinitionFolder(folder.path(), faults);
  ASSERT_EQ(all.size(), 2u) << "one broken file does not hide the others";
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_TRUE(holds(toText(faults[0]), "broken.json"));
  EXPECT_TRUE(holds(toText(faults[1]), "is \"own-arc\" in a file that is found as \"other-name\""));
  EXPECT_THROW((void)findDefinition("other-name", "c"), FaultError);
  EXPECT_EQ(all[0].name + " " + all[1].name, "own-arc own-tube");
  EXPECT_EQ(findDefinition("own-tube", "c").name, "own-tube");
  EXPECT_EQ(findDefinition("circle", "c").name, "circle");
  for (const char* none : {"own-tub", "", "x/own-tube", "../own-tube", "own-tube.json"})
    EXPECT_THROW((void)findDefinition(none, "c"), FaultError) << none;
  EXPECT_EQ(refusalOf([&] { (void)findDefinition("spheer", "c"); }),
            "c.name: there is no constraint 'spheer'; did you mean sphere?; allowed: free, or a name of the catalogue");
  EXPECT_EQ(generatedFunctions(all[0]).curve, nullptr);
  EXPECT_NE(generatedFunctions(*findInCatalogue("circle")).curveBatch, nullptr);
  Definition changed = *findInCatalogue("circle");
  changed.coordinates[0] = "radius_m*0.1*cos(phi)";
  EXPECT_EQ(generatedFunctions(changed).curve, nullptr) << "its code would be another formula's";
  for (const auto& [name, value] : before) {
    if (value) ::setenv(name.c_str(), value->c_str(), 1);
    else ::unsetenv(name.c_str());
  }
}

ConstraintSpec typed(const std::vector<std::string>& curve, const std::map<std::string, double>& shape = {}) {
  return {.curve = curve, .shape = shape};
}

TEST(TypedConstraint, IsRefusedInWords) {
  EXPECT_EQ(refusalOfConstraint(typed({"phi", "0"})), "c: has 2 formulas; allowed: three, one a coordinate");
  EXPECT_EQ(refusalOfConstraint({.name = "free", .shape = {{"a", 1}}}), "c.shape: free has no shape; allowed: no shape");
  EXPECT_EQ(refusalOfConstraint(typed({"a*phi", "0", "0"}, {{"a", 1}, {"b", 1}})),
            "c.curve: shape.b is used by no coordinate; allowed: names that the formula uses");
  EXPECT_TRUE(holds(refusalOfConstraint(typed({"phi", "0", "0"}, {{"phi", 1}})), "variable"));
  EXPECT_EQ(refusalOfConstraint(typed({"a*phi", "0", "0"}, {{"a", std::nan("")}})), "c.shape.a: is nan; allowed: any finite number");
  EXPECT_EQ(refusalOfConstraint(typed({"phi", "1 +", "0"})),
            "c.curve[1], character 4: unexpected end of the formula; expected a number, a name, a function or '('");
  EXPECT_EQ(refusalOfConstraint(typed({"1", "2", "3"})),
            "c: degenerates everywhere: r_phi is zero at every phi; allowed: a formula that moves with phi");
  EXPECT_EQ(refusalOfConstraint({.surface = {"u", "2*u", "3*u"}}),
            "c: degenerates everywhere: r_u x r_v is zero at every u, v; allowed: a formula that spans a surface");
  for (const char* nowhere : {"1/0", "phi + 0*log(0)", "-1/0 + phi", "sqrt(-1)"})
    EXPECT_EQ(refusalOfConstraint(typed({"phi", nowhere, "0"})).substr(0, 55), "c.curve[1], character 1: has no finite value anywhere: ")
        << nowhere;
  EXPECT_EQ(refusalOfConstraint(typed({"phi", "1e-300/1e-310", "0"})), "");
  EXPECT_EQ(refusalOfConstraint(typed({"phi", "0", "0*log(phi)"})),
            "c.curve[2], character 1: log(phi) cancels out, and what is left would go on where the formula as written has no value; "
            "allowed: a formula without it");
  for (const char* cancels :
       {"0*sqrt(phi)", "0*asin(phi)", "0*acos(phi)", "0*phi^0.3", "log(phi) - log(phi)", "asin(phi)/asin(phi)", "log(phi)^0"})
    for (const char* words : {"c.curve[1], character 1: ", " cancels out"})
      EXPECT_TRUE(holds(refusalOfConstraint(typed({"phi", cancels, "0"})), words)) << cancels;
  for (const char* whole : {"0*sqrt(phi^2 + 1)", "0*sin(phi)", "0*log(exp(phi))", "0*atan(phi)", "sqrt(1 + phi^2)^2", "sqrt(phi)*sqrt(phi)",
                            "2*log(phi + 9) - log(phi + 9)"})
    EXPECT_EQ(refusalOfConstraint(typed({"phi", whole, "0"})), "") << whole;
  std::map<std::string, double> shape;
  std::string sum = "phi";
  for (char name = 'a'; name <= 'h'; ++name) {
    if (name == 'e') continue;
    shape[std::string(1, name)] = 1;
    sum += std::string("+") + name + "*phi";
  }
  shape["i"] = 2, sum += "+i*phi";
  EXPECT_EQ(refusalOfConstraint(typed({sum, "0", "0"}, shape)), "") << "eight names";
  shape["j"] = 2, sum += "+j*phi";
  EXPECT_EQ(refusalOfConstraint(typed({sum, "0", "0"}, shape)), "c.curve: has 9 shape parameters; allowed: 8");
}

TEST(TypedConstraint, HasToBeFiniteWhereItIsUsed) {
  const auto used = [](const std::string& y, double lo, double hi) {
    ConstraintSpec spec = typed({"phi", y, "0"});
    spec.inUse = std::array<Domain, 2>{Domain{lo, hi, false}, Domain{0, 0, false}};
    return refusalOfConstraint(spec);
  };
  const std::string range = ", which no mass can cross; allowed: a range (from start to target, or the domain) without such a place";
  EXPECT_EQ(used("1/(phi - 1)", 0, 2), "c: not finite at phi = 1: pole of 1/(phi - 1)" + range);
  EXPECT_EQ(used("1/(phi - 1)", 1.5, 2), "");
  EXPECT_EQ(used("sign(phi - 1)", 0, 2), "c: jump at phi = 1: sign(phi - 1)" + range);
  EXPECT_EQ(used("sign(phi - 1)", 1.1, 2), "");
  EXPECT_EQ(used("sqrt(phi)", -1, 2), "c: not finite at phi = 0: end of sqrt(phi)" + range);
  EXPECT_EQ(used("abs(phi)", -1, 2), "");
}

TEST(TypedConstraint, KnowsItsNameItsKindAndItsOrder) {
  const Constraint curve = makeConstraint(typed({"a*phi", "b", "0"}, {{"b", 3}, {"a", 2}}));
  EXPECT_EQ(curve.name, "curve");
  EXPECT_EQ(curve.parameterCount(), 1);
  EXPECT_TRUE(curve.straight);
  EXPECT_EQ(evaluate(curve.curve, 5).r, (Vec3{10, 3, 0}));
  const Constraint saddle = surface({"u", "v", "u*v"});
  EXPECT_EQ(saddle.name, "surface");
  EXPECT_EQ(saddle.parameterCount(), 2);
  EXPECT_EQ(evaluate(saddle.surface, 2, 3).rUv, (Vec3{0, 0, 1}));
  const Constraint free = named("free");
  EXPECT_EQ(free.name, "free");
  EXPECT_EQ(free.parameterCount(), 0);
  EXPECT_EQ(ConstraintSpec{}.name, "line");
  EXPECT_TRUE(named("line").straight);
  EXPECT_EQ(makeConstraint({.name = "own-arc", .definition = kArcDefinition}).name, "own-arc");
}

}  // namespace
}  // namespace reachlab::constraints
