#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"
#include "constraints/curve_batch.h"
#include "tests/constraints/made_constraints.h"

namespace reachlab::constraints {
namespace {

/// Bits are compared: lanes do the operations of one point in their order.
void expectSameBits(const Curve& curve, const std::array<double, kBatchLanes>& phi, const std::string& name) {
  CurveBatch batch;
  curve.batch(curve.program, curve.shape.data(), phi.data(), batch);
  for (int lane = 0; lane < kBatchLanes; ++lane) {
    const CurvePoint p = evaluate(curve, phi[lane]);
    const Vec3 single[3] = {p.r, p.rPhi, p.rPhiPhi};
    for (int k = 0; k < 3; ++k) {
      const auto& lanes = k == 0 ? batch.r : k == 1 ? batch.rPhi : batch.rPhiPhi;
      const double values[3] = {single[k].x, single[k].y, single[k].z};
      for (int c = 0; c < 3; ++c) {
        const auto bits = [](double x) { return std::isnan(x) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(x); };
        EXPECT_EQ(bits(lanes[c][lane]), bits(values[c])) << name << " at " << phi[lane];
      }
    }
  }
}

void expectSameBitsEverywhere(const Curve& curve, const std::string& name) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> near(-7, 7);
  std::array<double, kBatchLanes> phi{};
  for (int round = 0; round < 50; ++round) {
    for (double& value : phi) value = near(random);
    expectSameBits(curve, phi, name);
  }
  phi[3] = 3e6;  // beyond the inlined sine
  expectSameBits(curve, phi, name);
  phi[5] = std::numeric_limits<double>::quiet_NaN();
  phi[6] = std::numeric_limits<double>::infinity();
  expectSameBits(curve, phi, name);
}

TEST(CurveBatch, OfEveryCurveOfTheCatalogueHasTheBitsOfSinglePoints) {
  int curves = 0;
  for (const Definition& definition : catalogue()) {
    if (definition.kind != ConstraintKind::Curve) continue;
    expectSameBitsEverywhere(makeConstraint(definition, {}, definition.name).curve, definition.name);
    ++curves;
  }
  EXPECT_GT(curves, 30);
}

TEST(CurveBatch, OfTypedFormulasHasTheBitsOfSinglePoints) {
  const std::vector<std::vector<std::string>> formulas{
      {"0.1*cos(phi)", "0.06*sin(phi)", "0"},
      {"phi", "exp(-phi^2)*tanh(phi)", "sqrt(1 + phi^2)"},
      {"atan2(sin(phi), 2 + cos(phi))", "abs(phi)*sign(phi - 20)", "3/(2 + cos(3*phi)) - phi"},
      {"sinh(phi/10) + cosh(phi/9)", "atan(phi) + asin(cos(phi)/3) + acos(sin(phi)/3)", "log(9 + phi)^2.5 + tan(phi/40)"},
      {"1 - phi", "2*phi*(3*phi)", "-(phi*phi) + 4 - phi*phi*sin(phi)"}};
  for (const auto& formula : formulas) expectSameBitsEverywhere(curve(formula).curve, formula[1]);
  const Constraint shaped = curve({"a*cos(phi)", "b*sin(phi)", "a - b*phi"}, {{"a", 0.1}, {"b", 0.06}});
  expectSameBitsEverywhere(shaped.curve, "with a shape");
}

}  // namespace
}  // namespace reachlab::constraints
