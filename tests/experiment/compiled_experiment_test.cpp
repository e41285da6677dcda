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
    EXPECT_EQ(compiled.experiment(), readExperiment(name));
    const constraints::Constraint own = constraints::makeConstraint(compiled.experiment().constraint);
    EXPECT_EQ(compiled.constraint().kind, own.kind) << name;
    EXPECT_EQ(compiled.constraint().name, own.name);
    EXPECT_EQ(compiled.constraint().straight, own.straight);
  }
}

TEST(CompiledExperiment, OfAValueIsEqualToTheOneFromItsFile) {
  for (const std::string& name : shippedExperiments()) {
    const Experiment value = readExperiment(name);
    EXPECT_EQ(CompiledExperiment(value).experiment(), value) << name;
  }
}

TEST(CompiledExperiment, RefusesAValueWithAFault) {
  Experiment e = readExperiment("chain-moderate");
  e.object.masses[2] = -1;
  EXPECT_NE(refusalOf([&] { const CompiledExperiment compiled(e); }).find("object.masses_kg[2]: is -1; allowed: 1e-06 to 1e+06 kg"),
            std::string::npos);
}

TEST(CompiledExperiment, ACopySharesBothParts) {
  const CompiledExperiment one = openExperiment("epitrochoid");
  const CompiledExperiment other = one;
  EXPECT_EQ(&one.experiment(), &other.experiment());
  EXPECT_EQ(&one.constraint(), &other.constraint());
}

}  // namespace
}  // namespace reachlab::experiment
