// How often a formula is compiled, counted where it is compiled (count_compilations.h).
#include <gtest/gtest.h>

#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"
#include "tests/constraints/count_compilations.h"

namespace reachlab::constraints {

TEST(Compilations, AreCounted) {
  (void)test::takeCompilations();
  const Constraint one = makeConstraint(ConstraintSpec{.curve = {"0", "cos(phi)", "sin(phi)"}});
  const Constraint copy = one;
  EXPECT_EQ(test::takeCompilations(), std::vector<std::string>{"0 | cos(phi) | sin(phi)"}) << "once, and not again for a copy";
  EXPECT_TRUE(test::takeCompilations().empty());
}

}  // namespace reachlab::constraints
