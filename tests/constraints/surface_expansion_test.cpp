// Taylor arithmetic over a formula's graph against the graph's own symbolic derivatives, order by order.
#include "constraints/constraint.h"
#include "constraints/geometry/surface_expansion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "constraints/catalogue/definition.h"

namespace reachlab::constraints {
namespace {

// Of the largest derivative of the same order: both ways round a few dozen operations.
constexpr double kRounding = 1e-11;

Constraint surfaceOf(const std::vector<std::string>& formula) {
  ConstraintSpec spec;
  spec.surface = formula;
  return makeConstraint(spec);
}

void expectSymbolicDerivatives(const Constraint& surface, double u, double v, const std::string& name) {
  auto formula = *std::static_pointer_cast<const CompiledFormula>(surface.owner);
  const SurfaceExpansion d = SurfaceFormula(surface).expand(u, v, kMaxExpansion);
  const std::array<double, 2> at{u, v};
  std::vector<int> alongU(formula.roots.begin(), formula.roots.begin() + 3);
  for (int a = 0; a <= kMaxExpansion; ++a) {
    std::vector<int> roots = alongU;
    for (int b = 0; a + b <= kMaxExpansion; ++b) {
      const auto values = evaluateNodes(formula.graph, roots, surface.surface.shape.data(), at.data());
      const Vec3 expected{values[0], values[1], values[2]};
      EXPECT_LT(norm(d[a][b] - expected), kRounding * (norm(expected) + norm(d[0][0]))) << name << " u^" << a << " v^" << b;
      if (a + b < kMaxExpansion) roots = formula.graph.differentiate(roots, 1);
    }
    if (a < kMaxExpansion) alongU = formula.graph.differentiate(alongU, 0);
  }
}

TEST(SurfaceExpansion, IsThatOfTheSymbolicDerivativesOnTheWholeCatalogue) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.1, 0.9);
  for (const Definition& definition : catalogue()) {
    if (definition.kind != ConstraintKind::Surface) continue;
    const Constraint surface = makeConstraint(definition);
    for (int trial = 0; trial < 3; ++trial) {
      std::array<double, 2> at{};
      for (size_t k = 0; k < 2; ++k) at[k] = definition.start[k] + part(random) * (definition.target[k] - definition.start[k]) + 0.01;
      expectSymbolicDerivatives(surface, at[0], at[1], definition.name);
    }
  }
}

TEST(SurfaceExpansion, KnowsEveryOperationOfTheLanguage) {
  for (const std::vector<std::string>& formula :
       std::vector<std::vector<std::string>>{{"sin(u*v) + cos(u - v)", "tan(u) - 0.3*tanh(v)", "exp(u*v)/(1 + v^2)"},
                                             {"asin(u*v)", "acos(u/2 + v/3)", "atan(u - 2*v)"},
                                             {"atan2(u + 2, v - 3)", "atan2(u - 2, v)", "sqrt(2 + u + v^3)"},
                                             {"sinh(u)*v", "cosh(v + u)", "log(3 + u*v)"},
                                             {"(2 + u)^v", "(1 + u^2)^(-2.5)", "u^-3 + v^4"},
                                             {"u*abs(v - 2)", "v*abs(u + 3)", "u*sign(v) + v*sign(u)"}})
    expectSymbolicDerivatives(surfaceOf(formula), 0.37, 0.61, formula[0]);
}

TEST(SurfaceExpansion, DoesNotDependOnTheUnitOfTheParameters) {
  const SurfaceFormula metres(surfaceOf({"u", "0.02*exp(-(u^2 + v^2)/(2*0.03^2))", "v"}));
  const SurfaceFormula millimetres(surfaceOf({"u/1000", "0.02*exp(-((u/1000)^2 + (v/1000)^2)/(2*0.03^2))", "v/1000"}));
  const SurfaceExpansion m = metres.expand(0.012, -0.02, 5), mm = millimetres.expand(12, -20, 5);
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; a + b <= 5; ++b)
      EXPECT_LT(norm(m[a][b] - std::pow(1000.0, a + b) * mm[a][b]), kRounding * (norm(m[a][b]) + norm(m[2][0]))) << a << b;
}

TEST(SurfaceExpansion, EndsWhereTheFormulaEnds) {
  const SurfaceFormula cap(surfaceOf({"u", "sqrt(4 - u^2 - v^2)", "v"}));
  EXPECT_TRUE(isFinite(cap.expand(1, 1, 5)[5][0]));
  EXPECT_FALSE(isFinite(cap.expand(2, 0, 1)[1][0]));
  EXPECT_FALSE(isFinite(cap.expand(2, 1, 0)[0][0]));
  ConstraintSpec line;
  EXPECT_THROW(SurfaceFormula(makeConstraint(line)), RefusedError);
}

}  // namespace
}  // namespace reachlab::constraints
