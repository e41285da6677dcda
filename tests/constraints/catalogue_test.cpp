#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "constraints/catalogue/generated_catalogue.h"
#include "constraints/regularity/analysis.h"
#include "tests/constraints/made_constraints.h"
#include "tests/refusal.h"

namespace reachlab::constraints {
namespace {

TEST(Catalogue, EveryDefinitionIsUsableAndFitsAHand) {
  for (const Definition& d : catalogue()) {
    SCOPED_TRACE(d.name);
    const Constraint c = makeConstraint(d);
    EXPECT_FALSE(d.sentence.empty());
    EXPECT_FALSE(d.source.empty());
    EXPECT_EQ(generatedFunctions(d).curve != nullptr || generatedFunctions(d).surface != nullptr, true);
    const auto place = [&](const std::vector<double>& q) {
      return c.kind == ConstraintKind::Curve ? evaluate(c.curve, q[0]).r : evaluate(c.surface, q[0], q[1]).r;
    };
    const double reach = norm(place(d.target) - place(d.start));
    EXPECT_GT(reach, 0.02) << "the reach is too short to be one";
    EXPECT_LT(reach, 0.45) << "the reach is longer than a seated arm's comfortable one";
  }
}

TEST(Catalogue, EveryDefinitionStandsTheEndsOfItsShape) {
  for (const Definition& d : catalogue()) {
    for (const ShapeParameter& p : d.shape)
      for (const double value : {p.min, p.max})
        EXPECT_NO_THROW(makeConstraint(d, {{p.name, value}})) << d.name << " " << p.name << " " << value;
  }
}

TEST(Catalogue, EveryPeriodClosesInPlaceAndDirection) {
  // Rounding of sines of up to 60 rad, scaled by derivatives up to 20 times the size.
  constexpr double kClosed = 1e-13;
  for (const Definition& d : catalogue()) {
    SCOPED_TRACE(d.name);
    const Constraint c = makeConstraint(d);
    if (c.kind == ConstraintKind::Curve && c.domain[0].periodic) {
      const CurvePoint a = evaluate(c.curve, c.domain[0].lo), b = evaluate(c.curve, c.domain[0].hi);
      EXPECT_LT(norm(a.r - b.r), kClosed);
      EXPECT_LT(norm(a.rPhi - b.rPhi), kClosed);
    }
    for (int k = 0; k < 2 && c.kind == ConstraintKind::Surface; ++k) {
      const Domain& domain = c.domain[k];
      if (!domain.periodic) continue;
      const double other = 0.37;
      const SurfacePoint a = k == 0 ? evaluate(c.surface, domain.lo, other) : evaluate(c.surface, other, domain.lo);
      const SurfacePoint b = k == 0 ? evaluate(c.surface, domain.hi, other) : evaluate(c.surface, other, domain.hi);
      EXPECT_LT(norm(a.r - b.r) + norm(a.rU - b.rU) + norm(a.rV - b.rV), kClosed);
    }
  }
}

TEST(Catalogue, DefinitionReadsBackEqualFromItsJson) {
  for (const Definition& d : catalogue()) EXPECT_EQ(toJson(parseDefinition(toJson(d), "again")), toJson(d)) << d.name;
}

TEST(Definition, HasTheSameFaultsAsAValueAndAsAFile) {
  const auto keysOf = [](const std::vector<Fault>& faults) {
    std::vector<std::string> keys;
    for (const Fault& fault : faults) keys.push_back(fault.key);
    return keys;
  };
  const Definition good = *findInCatalogue("ellipse");
  ASSERT_TRUE(problems(good).empty());
  struct Edit {
    const char* key;
    void (*change)(Definition&);
  };
  for (const Edit& edit :
       {Edit{"name", [](Definition& d) { d.name = "An Ellipse"; }}, Edit{"shape.a_m", [](Definition& d) { d.shape[0].min = 10; }},
        Edit{"curve[1]", [](Definition& d) { d.coordinates[1] = "a_m*cos(phj)"; }},
        Edit{"curve",
             [](Definition& d) {
               d.coordinates = {"0", "cos(phi)", "sin(phi)"};
             }},
        Edit{"domain", [](Definition& d) { std::swap(d.domain[0].lo, d.domain[0].hi); }},
        Edit{"domain[1]", [](Definition& d) { d.domain[0].hi = "2*pj"; }}}) {
    Definition changed = good;
    edit.change(changed);
    const std::vector<Fault> value = problems(changed);
    ASSERT_FALSE(value.empty()) << edit.key;
    EXPECT_EQ(value[0].key, edit.key) << toText(value);
    const std::vector<Fault> read = faultsToldBy([&] { parseDefinition(toJson(changed), "d.json"); });
    EXPECT_EQ(keysOf(read), keysOf(value)) << toText(read);
    for (const Fault& fault : read) EXPECT_GT(fault.place.value_or(FilePlace{}).line, 0) << toText(fault);
  }
}

}  // namespace
}  // namespace reachlab::constraints
