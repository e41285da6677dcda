#include "constraints/constraint.h"
#include "sim/experiment/compiled_experiment.h"

#include <gtest/gtest.h>

#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "tests/refusal.h"

namespace reachlab::experiment {
namespace {

TEST(CompiledExperiment, OfAShippedFileIsTheExperimentWithItsConstraint) {
  for (const std::string& name : shippedExperiments()) {
    const CompiledExperiment compiled = openExperiment(name);
    const Experiment value = readExperiment(name);
    EXPECT_EQ(compiled.experiment(), value);
    EXPECT_EQ(CompiledExperiment(value).experiment(), value);
    const constraints::Constraint own = constraints::makeConstraint(compiled.experiment().constraint);
    EXPECT_EQ(compiled.constraint().kind, own.kind) << name;
    EXPECT_EQ(compiled.constraint().name, own.name);
    EXPECT_EQ(compiled.constraint().straight, own.straight);
  }
}

TEST(CompiledExperiment, ACopySharesBothParts) {
  const CompiledExperiment one = openExperiment("epitrochoid");
  const CompiledExperiment other = one;
  EXPECT_EQ(&one.experiment(), &other.experiment());
  EXPECT_EQ(&one.constraint(), &other.constraint());
}

}  // namespace
}  // namespace reachlab::experiment
