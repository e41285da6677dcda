#include "constraints/formula/cpp_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "base/math/vec3.h"
#include "constraints/constraint.h"
#include "constraints/curve_batch.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/program.h"
#include "tests/constraints/random_formulas.h"
#include "tests/refusal.h"

namespace reachlab::constraints {
namespace {

std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}

/// A line of C++ as a formula: without std::, with sign for signOf and (x)^(y) for pow(x, y).
std::string asFormula(std::string text) {
  text = replacedAll(replacedAll(text, "std::", ""), "signOf", "sign");
  for (std::size_t at; (at = text.find("pow(")) != std::string::npos;) {
    int depth = 0;
    std::size_t end = at + 3;
    for (; end < text.size(); ++end) {
      depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
      if (depth == 0) break;
      if (depth == 1 && text[end] == ',') text.replace(end, 2, ")^("), end += 2;
    }
    text.insert(end, ")").replace(at, 3, "(");
  }
  return text;
}

/// What `expressions` are worth behind C++ statements "const double NAME = EXPRESSION;".
std::vector<double> runCpp(const std::string& statements, const std::vector<std::string>& expressions, std::vector<std::string> names,
                           std::vector<double> values) {
  const auto worth = [&](const std::string& text) {
    ExpressionGraph graph;
    const int root = nodeOf(graph, asFormula(text), {}, names);
    return root < 0 ? NAN : evaluateNodes(graph, std::array{root}, values.data(), nullptr)[0];
  };
  const auto name = [&](const std::string& as, double value) {
    names.push_back(as);
    values.push_back(value);
  };
  for (std::size_t at = 0; at < statements.size();) {
    const std::size_t end = std::min(statements.find(";\n", at), statements.size());
    const std::string line = statements.substr(at, end - at);
    at = end + 2;
    if (const std::size_t call = line.find("sinCos"); call != std::string::npos) {  // of ANGLE, SINE, COSINE
      const std::size_t open = line.find('(', call), second = line.rfind(", "), first = line.rfind(", ", second - 1);
      const double angle = worth(line.substr(open + 1, first - open - 1));
      name(line.substr(first + 2, second - first - 2), std::sin(angle));
      name(line.substr(second + 2, line.size() - second - 3), std::cos(angle));
    } else if (const std::size_t number = line.find("const double "), is = line.find(" = "); number != std::string::npos) {
      name(line.substr(number + 13, is - number - 13), worth(line.substr(is + 3)));
    }
  }
  std::vector<double> result;
  for (const std::string& expression : expressions) result.push_back(worth(expression));
  return result;
}

TEST(WrittenCode, OfAnExpressionIsWorthTheSame) {
  forManyFormulas(5, 1000, [](ExpressionGraph& graph, int root, const auto& place, const Dual& expected, double tolerance) {
    const std::vector<int> roots{root, graph.powInt(root, 3)};
    const CppWriter writer(graph, roots, {kVariables, kParameters, ""});
    const std::string code = writer.statements() + writer.expression(0);
    if (code.find("NAN") != std::string::npos || code.find("INFINITY") != std::string::npos) return;
    const std::vector<double> worth = runCpp(writer.statements(), {writer.expression(0), writer.expression(1)}, {"u", "v", "a", "b"},
                                             {place[0], place[1], kShape[0], kShape[1]});
    EXPECT_NEAR(worth[0], expected.x, tolerance) << code;
    EXPECT_NEAR(worth[1], std::pow(expected.x, 3), tolerance * (1 + 3 * expected.x * expected.x));
  });
}

std::shared_ptr<const CompiledFormula> compiled(ConstraintKind kind, const std::array<std::string, 3>& coordinates) {
  std::vector<std::string> parameters;
  for (const char* name : {"a", "double"})
    for (const std::string& coordinate : coordinates)
      if (coordinate.find(name) != std::string::npos && std::find(parameters.begin(), parameters.end(), name) == parameters.end())
        parameters.push_back(name);
  return compileFormula({kind, coordinates, parameters}, "here");
}
const std::array<std::string, 3> kCurveCoordinates{"a*cos(phi) + double", "a*sin(phi)*exp(0.3*phi)", "abs(phi - 1)*sin(3*phi)"};
const std::array<std::string, 3> kSurfaceCoordinates{"a*cos(u)*v^2", "double*sin(u + 2*v)", "atan2(u, v)*a"};
constexpr double kShapeOf[] = {0.7, 1.3};

/// What stands behind `before`, up to `end`.
std::string behind(const std::string& code, const std::string& before, const std::string& end) {
  const std::size_t at = code.find(before);
  EXPECT_NE(at, std::string::npos) << before << " in\n" << code;
  return at == std::string::npos ? "" : code.substr(at + before.size(), code.find(end, at) - at - before.size());
}
/// The arguments of a list, at its own commas.
std::vector<std::string> parts(const std::string& list) {
  std::vector<std::string> all(1);
  int depth = 0;
  for (const char c : list) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0) all.emplace_back();
    else if (c != ' ' || !all.back().empty()) all.back() += c;
  }
  return all;
}
std::string withShape(std::string code) {
  for (const auto& [from, to] : {std::pair{"shape[0]", "0.7"}, {"shape[1]", "1.3"}, {"elementary::", ""}})
    code = replacedAll(code, from, to);
  return code;
}
void expectVector(const std::vector<double>& got, const Vec3& expected, const std::string& what) {
  ASSERT_EQ(got.size(), 3u);
  EXPECT_NEAR(norm(Vec3{got[0], got[1], got[2]} - expected), 0, 1e-13 * (1 + norm(expected))) << what;
}

TEST(WrittenCode, OfACurveIsItsPointSinglyAndInLanes) {
  const auto formula = compiled(ConstraintKind::Curve, kCurveCoordinates);
  const double phi = 1.7;
  CurvePoint point;
  evaluateCurveProgram(&formula->program, kShapeOf, phi, point);
  const std::string single = withShape(writeEvaluator(*formula, "evaluateOwn"));
  EXPECT_EQ(single.find("// {a*cos(phi) + double, a*sin(phi)*exp(0.3*phi), abs(phi - 1)*sin(3*phi)}\nvoid evaluateOwn(const void*, "
                        "[[maybe_unused]] const double* shape, [[maybe_unused]] double phi, CurvePoint& p) noexcept {\n  "),
            0u)
      << single;
  EXPECT_TRUE(holds(single, "const double doubleShape = 1.3;")) << "no word of C++";
  EXPECT_TRUE(holds(single, "sinCos(phi, sinPhi, cosPhi);"));
  EXPECT_TRUE(holds(single, "sin3Phi"));
  const std::string batch = withShape(writeBatchEvaluator(*formula, "evaluateOwn"));
  EXPECT_EQ(batch.find("void evaluateOwnBatch(const void*, const double* shape, const double* __restrict phis, CurveBatch& __restrict p) "
                       "noexcept {\n  "),
            0u)
      << batch;
  EXPECT_TRUE(holds(batch, "  for (int lane = 0; lane < kBatchLanes; ++lane) {\n    [[maybe_unused]] const double phi = phis[lane];\n"));
  EXPECT_TRUE(holds(batch, "    far |= sinCosNear(phi, sinPhi, cosPhi);\n"));
  EXPECT_TRUE(holds(batch, "  if (far != 0) evaluateSingly(evaluateOwn, nullptr, shape, phis, p);\n}\n"));
  const std::vector<std::pair<std::string, Vec3>> members{{"r", point.r}, {"rPhi", point.rPhi}, {"rPhiPhi", point.rPhiPhi}};
  const std::string inLanes =
      replacedAll(batch, "for (int lane = 0; lane < kBatchLanes; ++lane) {\n    [[maybe_unused]] const double phi = phis[lane];", "");
  for (const auto& [member, expected] : members) {
    expectVector(runCpp(single, parts(behind(single, "p." + member + " = {", "};")), {"phi"}, {phi}), expected, member);
    std::vector<std::string> lanes;
    for (int k = 0; k < 3; ++k) lanes.push_back(behind(batch, "p." + member + "[" + std::to_string(k) + "][lane] = ", ";"));
    expectVector(runCpp(inLanes, lanes, {"phi"}, {phi}), expected, member);
  }
}

TEST(WrittenCode, OfASurfaceIsItsPoint) {
  const auto formula = compiled(ConstraintKind::Surface, kSurfaceCoordinates);
  SurfacePoint point;
  evaluateSurfaceProgram(&formula->program, kShapeOf, 0.6, 1.4, point);
  const std::string code = withShape(writeEvaluator(*formula, "evaluateOwn"));
  EXPECT_TRUE(holds(code, "[[maybe_unused]] double u, [[maybe_unused]] double v, SurfacePoint& p) noexcept {"));
  const std::pair<const char*, Vec3> members[] = {{"r", point.r},     {"rU", point.rU},   {"rV", point.rV},
                                                  {"rUu", point.rUu}, {"rUv", point.rUv}, {"rVv", point.rVv}};
  for (const auto& [member, expected] : members)
    expectVector(runCpp(code, parts(behind(code, std::string("p.") + member + " = {", "};")), {"u", "v"}, {0.6, 1.4}), expected, member);
}

// Eq. (11): m |r'|^2 phi'' + lambda |r'|^2 phi' + m (r'.r'') phi'^2 = r'.f.
TEST(WrittenCode, OfACurvesDynamicsHasItsCoefficients) {
  const auto formula = compiled(ConstraintKind::Curve, kCurveCoordinates);
  const std::string code = writeDynamicsCode(*formula, "own-curve", {0.25});
  EXPECT_EQ(code.find("#include <cmath>\n\n// own-curve: r(phi) = {a*cos(phi) + double, "), 0u) << code;
  EXPECT_TRUE(holds(code, "struct OwnCurveDynamics {\n  double x, y, z, M, L, V, Q;\n};\n"));
  EXPECT_TRUE(
      holds(code,
            "inline OwnCurveDynamics computeOwnCurveDynamics([[maybe_unused]] double phi, [[maybe_unused]] double fx, "
            "[[maybe_unused]] double fy, [[maybe_unused]] double fz, [[maybe_unused]] double m, [[maybe_unused]] double lambda, double a "
            "= 0.25, double doubleShape) {\n  /*----- Curve coordinates"));
  EXPECT_TRUE(holds(code, "inline double signOf(double x)"));
  EXPECT_EQ(writeDynamicsCode(*compiled(ConstraintKind::Curve, {"a*phi", "phi^2", "0"}), "x", {}).find("signOf"), std::string::npos);
  CurvePoint p;
  evaluateCurveProgram(&formula->program, kShapeOf, 1.7, p);
  const Vec3 f{1.1, -0.6, 2.3};
  const double m = 1.9, lambda = 0.4, square = dot(p.rPhi, p.rPhi);
  const std::pair<const char*, double> outputs[] = {{"x", p.r.x},         {"y", p.r.y},           {"z", p.r.z},
                                                    {"M", m * square},    {"L", lambda * square}, {"V", m * dot(p.rPhi, p.rPhiPhi)},
                                                    {"Q", dot(p.rPhi, f)}};
  for (const auto& [output, expected] : outputs)
    EXPECT_NEAR(runCpp(code.substr(code.find("-----*/")), {behind(code, std::string("out.") + output + " = ", ";")},
                       {"phi", "fx", "fy", "fz", "m", "lambda", "a", "doubleShape"}, {1.7, f.x, f.y, f.z, m, lambda, 0.7, 1.3})[0],
                expected, 1e-12 * (1 + std::abs(expected)))
        << output;
}

// Eq. (13): G = J'J, C = J' (r_uu u'^2 + 2 r_uv u'v' + r_vv v'^2), Q = J' f.
TEST(WrittenCode, OfASurfacesDynamicsHasItsCoefficients) {
  const auto formula = compiled(ConstraintKind::Surface, kSurfaceCoordinates);
  const std::string code = writeDynamicsCode(*formula, "own-surface", {0.7, 1.3});
  EXPECT_TRUE(holds(code, "// own-surface: r(u, v) = {"));
  EXPECT_TRUE(holds(code, "/*----- Surface coordinates and dynamic parameters -----*/\n"));
  EXPECT_TRUE(holds(code, "[[maybe_unused]] double uRate, [[maybe_unused]] double vRate, double a = 0.7, double doubleShape = 1.3) {"));
  SurfacePoint p;
  evaluateSurfaceProgram(&formula->program, kShapeOf, 0.6, 1.4, p);
  const Vec3 f{1.1, -0.6, 2.3};
  const double du = 0.8, dv = -1.7;
  const Vec3 w = du * du * p.rUu + 2 * du * dv * p.rUv + dv * dv * p.rVv;
  const std::pair<const char*, double> outputs[] = {
      {"y", p.r.y},         {"G11", dot(p.rU, p.rU)}, {"G12", dot(p.rU, p.rV)}, {"G22", dot(p.rV, p.rV)},
      {"C1", dot(p.rU, w)}, {"C2", dot(p.rV, w)},     {"Q1", dot(p.rU, f)},     {"Q2", dot(p.rV, f)}};
  for (const auto& [output, expected] : outputs)
    EXPECT_NEAR(runCpp(code.substr(code.find("-----*/")), {behind(code, std::string("out.") + output + " = ", ";")},
                       {"u", "v", "fx", "fy", "fz", "uRate", "vRate", "a", "doubleShape"}, {0.6, 1.4, f.x, f.y, f.z, du, dv, 0.7, 1.3})[0],
                expected, 1e-12 * (1 + std::abs(expected)))
        << output;
}

TEST(WrittenCode, HasNamesThatNobodyElseHas) {
  EXPECT_EQ(cppIdentifier("size", {}), "size");
  EXPECT_EQ(cppIdentifier("while", {}), "whileShape");
  EXPECT_EQ(cppIdentifier("size", {"size"}), "sizeShape");
  EXPECT_EQ(cppIdentifier("size", {"sizeShape", "size"}), "sizeShapeShape");
  EXPECT_EQ(cppIdentifier("_x", {}), "shape_x");
  EXPECT_EQ(cppIdentifier("a__b___c", {}), "shapea_b_c");
  EXPECT_EQ(cppIdentifier("a_b_c", {}), "a_b_c");
  const auto twoNames = compileFormula({ConstraintKind::Curve, {"double*phi", "doubleShape*phi", "0"}, {"double", "doubleShape"}}, "here");
  EXPECT_TRUE(holds(writeEvaluator(*twoNames, "f"), "const double doubleShape = shape[0];\n  const double doubleShapeShape = shape[1];"));
  EXPECT_EQ(upperCamel("spherical-spiral"), "SphericalSpiral");
  EXPECT_EQ(upperCamel("a-9z-zA"), "A9zZA");
  EXPECT_EQ(upperCamel(""), "");
  const auto formula =
      compileFormula({ConstraintKind::Curve, {"sinPhi*sin(phi)", "t1*sqrt(phi + 2)", "sqrt(phi + 2)"}, {"sinPhi", "t1"}}, "here");
  const std::string code = writeEvaluator(*formula, "f");
  EXPECT_TRUE(holds(code, "sinCos(phi, sinPhi_, cosPhi);"));
  EXPECT_EQ(code.find("const double t1 = std"), std::string::npos) << code;
  EXPECT_TRUE(holds(code, "const double t1_ = "));
}

}  // namespace
}  // namespace reachlab::constraints
