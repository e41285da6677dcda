#include "sim/experiment/describe.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "tests/refusal.h"

namespace reachlab::experiment {
namespace {

std::string toldOf(const std::string& name, const std::function<void(Experiment&)>& change) {
  Experiment e = readExperiment(name);
  change(e);
  return describe(e);
}

TEST(Describe, TellsMassesAndSpringsOnceWhereTheyAreAlike) {
  const auto chain = [](const std::function<void(Object&)>& change) {
    return toldOf("chain-moderate", [&](Experiment& e) { change(e.object); });
  };
  EXPECT_TRUE(chain([](Object&) {}).starts_with("a chain of 5 masses (0.6 kg each) joined by springs of 600 N/m each, the first coupled"));
  EXPECT_TRUE(chain([](Object& o) { o.masses[4] = 0.7; }).starts_with("a chain of 5 masses (0.6, 0.6, 0.6, 0.6, 0.7 kg) joined"));
  EXPECT_TRUE(holds(chain([](Object& o) { o.stiffness = {1, 2, 3, 4}; }), "springs of 1, 2, 3, 4 N/m, the first"));
  EXPECT_TRUE(holds(chain([](Object& o) { o.damping = {0, 0, 0, 2}; }), "N/m each, dampers of 0, 0, 0, 2 N s/m, the first"));
  EXPECT_TRUE(holds(chain([](Object& o) { o.viscosity = 1.5; }), ", in a field of viscosity 1.5 N s/m, the first"));
  for (const Vec3& g : {Vec3{1, 0, 0}, Vec3{0, -9.81, 0}, Vec3{0, 0, 2}})
    EXPECT_TRUE(holds(chain([&](Object& o) { o.gravity = g; }), ", gravity ("));
  EXPECT_TRUE(holds(chain([](Object& o) { o.gravity = {0, -9.81, 0}; }), ", gravity (0, -9.81, 0) m/s^2, the first"));
  EXPECT_FALSE(holds(chain([](Object&) {}), "gravity") || holds(chain([](Object&) {}), "viscosity") ||
               holds(chain([](Object&) {}), "dampers"));
}

TEST(Describe, TellsHowTheHandHolds) {
  const std::string point = toldOf("chain-moderate", [](Experiment& e) {
    e.object.kind = ObjectKind::Point;
    e.object.masses = {2.5};
    e.object.stiffness.clear(), e.object.damping.clear();
    e.coupling = Coupling{100, 0};
  });
  EXPECT_TRUE(point.starts_with("one mass of 2.5 kg, coupled to the hand by 100 N/m, on line")) << point;
  EXPECT_TRUE(holds(toldOf("chain-moderate", [](Experiment& e) { e.coupling->damping = 3; }), "to the hand by 600 N/m and 3 N s/m, on"));
  EXPECT_TRUE(
      toldOf("parallel", [](Experiment&) {}).starts_with("2 parallel masses (3 kg each), tied to the hand by springs of 50, 250 N/m, on"));
  EXPECT_TRUE(toldOf("free-body", [](Experiment&) {}).starts_with("a rigid body of "));
}

TEST(Describe, TellsTheConstraintsFormula) {
  const auto typed = [](const std::function<void(constraints::ConstraintSpec&)>& change) {
    return toldOf("chain-moderate", [&](Experiment& e) {
      e.constraint = {};
      change(e.constraint);
    });
  };
  EXPECT_TRUE(holds(typed([](auto& c) {
                      c.curve = {"phi", "a*phi", "0"}, c.shape = {{"a", 2}, {"b", 0.5}};
                    }),
                    ", on r(phi) = (phi, a*phi, 0) m with a = 2, b = 0.5; from rest"));
  EXPECT_TRUE(holds(typed([](auto& c) { c.surface = {"u", "v", "0"}; }), ", on r(u, v) = (u, v, 0) m; from rest"));
  EXPECT_TRUE(holds(typed([](auto& c) { c.name = "free"; }), ", free in space; from rest"));
  EXPECT_TRUE(
      holds(toldOf("chain-moderate", [](Experiment& e) { e.constraint.shape["length_m"] = 0.3; }), ") m with length_m = 0.3; from"));
}

TEST(Describe, TellsTheTaskByItsCoordinates) {
  const auto task = [](const std::function<void(Task&)>& change) {
    return toldOf("chain-moderate", [&](Experiment& e) { change(*e.task); });
  };
  EXPECT_TRUE(
      holds(task([](Task& t) { t.start = {1}, t.target = {2.5}; }), "; from rest at phi = 1 to rest at phi = 2.5 in 1.35 ± 0.5 s, every"));
  EXPECT_TRUE(holds(task([](Task& t) { t.start = {1, 2}, t.target = {3, 4}; }), "at (u, v) = (1, 2) to rest at (u, v) = (3, 4) in"));
  EXPECT_TRUE(holds(task([](Task& t) { t.start = {1, 2, 3}; }), "; from rest at (1, 2, 3) m to"));
  EXPECT_TRUE(task([](Task& t) { t.tolerance = {0.02, 0.03, 0.1}; }).ends_with("± 0.1 s, every mass within 0.02 m and 0.03 m/s"));
  EXPECT_TRUE(holds(task([](Task& t) { t.tolerance.time = 1.35; }), "at phi = 6.28319 within 2.7 s, every"));
  EXPECT_FALSE(holds(toldOf("chain-moderate", [](Experiment& e) { e.task.reset(); }), "rest"));
}

TEST(Describe, APaceWithoutALeastIsAnUpperBound) {
  Task task;
  task.duration = 2, task.tolerance.time = 1.9;
  EXPECT_EQ(describePace(task), "2 ± 1.9 s");
  task.tolerance.time = 2;
  EXPECT_EQ(describePace(task), "within 4 s");
  task.tolerance.time = 3;
  EXPECT_EQ(describePace(task), "within 5 s");
}

TEST(Resources, ANameThatIsNoExperimentIsAnsweredByWhatItIs) {
  const auto told = [](const std::string& name) { return refusalOf([&] { (void)openExperiment(name); }, "opened"); };
  EXPECT_EQ(told("chain-moderate"), "opened");
  for (const std::string& name : shippedForTwoHands()) EXPECT_EQ(told(name), "opened") << name;
  EXPECT_TRUE(told(".").starts_with(".: is a folder; allowed: an experiment file or name"));
  EXPECT_TRUE(holds(told("nothing.json"), "nothing.json: there is no such file; allowed: an experiment file, or one of "));
  EXPECT_TRUE(holds(told("no/thing"), "no/thing: there is no such file"));
  EXPECT_TRUE(holds(told("paper"), "is a session plan, and an experiment is needed here"));
  EXPECT_TRUE(holds(told("xyzzy"), "xyzzy: is neither a file nor a shipped experiment; allowed: a file, or one of "));
}

}  // namespace
}  // namespace reachlab::experiment
