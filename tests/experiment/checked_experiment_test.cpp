#include "base/fault.h"
#include "constraints/constraint.h"
#include "sim/experiment/checked_experiment.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "tests/refusal.h"

namespace reachlab::experiment {
namespace {

std::vector<Fault> faultsOfText(const std::string& text) {
  return faultsToldBy([&] { openExperimentText(text, "x.json"); });
}

struct Edit {
  const char* name;
  std::string key;  // of the first fault
  std::function<void(Experiment&)> change;
};

std::vector<Edit> edits() {
  return {
      {"mass", "object.masses_kg[1]", [](Experiment& e) { e.object.masses[1] = -1; }},
      {"coupling beside parallel", "coupling",
       [](Experiment& e) {
         e.object.kind = ObjectKind::Parallel;
         e.object.stiffness.assign(e.object.masses.size(), 50);
         e.object.damping.assign(e.object.masses.size(), 0);
       }},
      {"body on a line", "object.kind",
       [](Experiment& e) {
         e.object = {};
         e.object.kind = ObjectKind::Body;
         e.object.masses = {1};
         for (std::size_t i = 0; i < 3; ++i) e.object.inertia[i][i] = 0.01;
       }},
      {"inertia with too great products", "object.inertia_kg_m2",  // its first two minors are positive, its determinant is not
       [](Experiment& e) {
         e.object = {};
         e.object.kind = ObjectKind::Body;
         e.object.masses = {1};
         for (std::size_t i = 0; i < 3; ++i)
           for (std::size_t j = 0; j < 3; ++j) e.object.inertia[i][j] = i == j ? 0.01 : -0.006;
         e.constraint.name = "free";
         e.constraint.shape.clear();
         e.task.reset();
       }},
      {"two coordinates on a line", "task.start",
       [](Experiment& e) {
         e.task->start = {0, 1};
       }},
      {"method", "method", [](Experiment& e) { e.method = "euler"; }},
      {"arm", "arm.link_mass_kg[1]", [](Experiment& e) { e.arm.mass[1] = 0; }},
      {"unknown shape", "constraint.shape.lenght_m", [](Experiment& e) { e.constraint.shape["lenght_m"] = 1; }},
      {"unknown constraint", "constraint.name", [](Experiment& e) { e.constraint.name = "lime"; }},
      {"formula", "constraint.curve[1]",
       [](Experiment& e) {
         e.constraint = {};
         e.constraint.curve = {"0", "0.1*cos(phi", "0.1*sin(phi)"};
       }},
      {"not finite where it moves", "constraint",
       [](Experiment& e) {
         e.constraint = {};
         e.constraint.curve = {"phi/10", "1/(phi - 1)", "0"};
       }},
  };
}

}  // namespace

TEST(CheckedExperiment, AValueAndItsFileHaveTheSameFaults) {
  for (const Edit& edit : edits()) {
    Experiment e = readExperiment("chain-moderate");
    edit.change(e);
    const std::vector<Fault> value = check(e).faults, file = faultsOfText(toJson(e));
    ASSERT_FALSE(value.empty()) << edit.name;
    EXPECT_EQ(value[0].key, edit.key) << edit.name << ": " << toText(value);
    ASSERT_EQ(value.size(), file.size()) << edit.name << "\n" << toText(value) << "\n" << toText(file);
    for (std::size_t i = 0; i < value.size(); ++i) {
      EXPECT_EQ(value[i].key, file[i].key) << edit.name;
      EXPECT_EQ(value[i].what, file[i].what) << edit.name;
      EXPECT_EQ(value[i].allowed, file[i].allowed) << edit.name;
      ASSERT_TRUE(file[i].place) << edit.name << ": the reader says where it stands";
      EXPECT_EQ(file[i].place->file, "x.json");
      EXPECT_GT(file[i].place->line, 1) << edit.name;
    }
    EXPECT_THROW(CompiledExperiment{e}, FaultError) << edit.name;
  }
}

TEST(CheckedExperiment, OfAValueThatIsNotFinite) {
  Experiment e = readExperiment("chain-moderate");
  e.object.masses[0] = std::numeric_limits<double>::quiet_NaN();
  e.task->target[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(toText(check(e).faults),
            "object.masses_kg[0]: is nan; allowed: 1e-06 to 1e+06 kg\ntask.target[0]: is inf; allowed: -1e+09 to 1e+09");
}

// An editor has no file: the character stands for the place.
TEST(CheckedExperiment, NamesTheCharacterOfAFormula) {
  Experiment e = readExperiment("chain-moderate");
  e.constraint = {};
  e.constraint.curve = {"0", "0.1*cos(phi)", "0.1*sni(phi)"};
  const std::vector<Fault> value = check(e).faults;
  ASSERT_EQ(value.size(), 1u) << toText(value);
  EXPECT_TRUE(toText(value[0]).starts_with("constraint.curve[2], character 5: ")) << toText(value);
  const std::vector<Fault> file =
      faultsOfText(R"json({ "schema_version": 1, "object": { "kind": "point", "masses_kg": [1] }, "coupling": { "stiffness_n_per_m": 600 },
"constraint": { "curve": ["0", "0.1*cos(phi)", "0.1*sni(phi)"]
}
})json");
  ASSERT_EQ(file.size(), 1u) << toText(file);
  EXPECT_TRUE(toText(file[0]).starts_with("x.json:2:53: constraint.curve[2]: ")) << toText(file);
}

TEST(CheckedExperiment, WhatCannotBeReadHasNoFaultsThatFollowFromIt) {
  const std::vector<Fault> kind = faultsOfText(R"({ "schema_version": 1, "constraint": { "name": "line" },
"object": { "kind": "chian", "masses_kg": [1, 1, 1], "stiffness_n_per_m": [1, 1] }, "hand_mass_kg": -1 })");
  EXPECT_EQ(keysTold(kind), "object.kind hand_mass_kg") << toText(kind);
  const std::vector<Fault> masses = faultsOfText(R"({ "schema_version": 1, "constraint": { "name": "line" },
"object": { "kind": "chain", "masses_kg": "three", "stiffness_n_per_m": [1, 1] }, "coupling": { "stiffness_n_per_m": -1 } })");
  EXPECT_EQ(keysTold(masses), "object.masses_kg coupling.stiffness_n_per_m") << toText(masses);
}

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

}  // namespace reachlab::experiment
