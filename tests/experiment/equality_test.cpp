#include "sim/experiment/equality.h"

#include <gtest/gtest.h>

#include <functional>

namespace reachlab::experiment {
namespace {

// A constraint is compiled anew when any part of it has changed, and not when none has.
TEST(Equality, OfConstraintsEndsWithAnySingleDifference) {
  constraints::ConstraintSpec spec;
  spec.name = "line";
  spec.curve = {"phi", "0", "0"};
  spec.surface = {"u", "v", "0"};
  spec.shape = {{"length_m", 0.2}};
  spec.inUse.emplace();
  spec.definition = "{}";
  using Change = std::function<void(constraints::ConstraintSpec&)>;
  const std::vector<std::pair<const char*, Change>> changes{
      {"name", [](auto& s) { s.name = "circle"; }},
      {"curve", [](auto& s) { s.curve[1] = "phi"; }},
      {"surface", [](auto& s) { s.surface[2] = "u"; }},
      {"a shape's value", [](auto& s) { s.shape.begin()->second = 0.3; }},
      {"a shape's key", [](auto& s) { s.shape.clear(); }},
      {"no domain in use", [](auto& s) { s.inUse.reset(); }},
      {"domain in use", [](auto& s) { (*s.inUse)[1].periodic = !(*s.inUse)[1].periodic; }},
      {"definition", [](auto& s) { s.definition = "{ }"; }},
  };
  EXPECT_TRUE(isSameConstraint(spec, spec));
  for (const auto& [part, change] : changes) {
    constraints::ConstraintSpec changed = spec;
    change(changed);
    EXPECT_FALSE(isSameConstraint(spec, changed)) << part;
    EXPECT_FALSE(isSameConstraint(changed, spec)) << part;
  }
}

}  // namespace
}  // namespace reachlab::experiment
