// What an experiment's value is: every key of its file and every bound.
#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment_keys.h"
#include "tests/refusal.h"

namespace reachlab::experiment {
namespace {

const CompiledExperiment& chain() {
  static const CompiledExperiment compiled = openExperiment("chain-moderate");
  return compiled;
}

std::vector<Fault> faultsOf(const Experiment& e, const CompiledExperiment& compiled = chain()) {
  return check(e, &compiled.constraint()).faults;
}

/// Puts each number of an experiment beyond both ends of its range; what the ranges are is compared with the schema.
struct BeyondRange {
  std::string group;
  Experiment& changed;

  template <class T>
  void operator()(const Key& key, T& value) const {
    const std::string path = group.empty() ? key.name : group + "." + key.name;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if constexpr (requires { value.has_value(); }) {
      if (value) (*this)(key, *value);
    } else if constexpr (std::same_as<T, std::array<double, 2>>) {
      for (std::size_t i = 0; i < 2; ++i) (*this)(Key{fmt::format("{}[{}]", key.name, i).c_str(), key.range}, value[i]);
    } else if constexpr (std::same_as<T, double>) {
      const double good = value;
      for (const double fine : {key.range.loIncluded ? key.range.lo : std::nextafter(key.range.lo, kInfinity), key.range.hi}) {
        if (!std::isfinite(fine)) continue;
        value = fine;
        EXPECT_TRUE(faultsOf(changed).empty()) << path << " " << fine;
      }
      for (const double bad : {key.range.loIncluded ? std::nextafter(key.range.lo, -kInfinity) : key.range.lo,
                               std::nextafter(key.range.hi, kInfinity), std::nan("")}) {
        value = bad;
        const std::vector<Fault> faults = faultsOf(changed);
        ASSERT_EQ(faults.size(), 1u) << path << " " << bad;
        EXPECT_EQ(faults[0].key, path);
        EXPECT_EQ(faults[0].allowed, key.range.allowed);
      }
      value = good;
    } else if constexpr (requires { visitKeys(value, *this); }) {
      visitKeys(value, BeyondRange{path, changed});
    }
  }
};

TEST(ExperimentValue, EveryNumberReachesToItsBoundsAndNoFurther) {
  Experiment e = chain().experiment();
  e.forceLimit = 8;
  visitKeys(e, BeyondRange{{}, e});
}

// The one fault that a change makes, or "none".
std::string toldOf(const std::function<void(Experiment&)>& change, const CompiledExperiment& compiled = chain()) {
  Experiment e = compiled.experiment();
  change(e);
  const std::vector<Fault> faults = faultsOf(e, compiled);
  return faults.empty() ? "none" : toText(faults);
}

TEST(ExperimentValue, WholeNumbersHaveTheirBounds) {
  EXPECT_EQ(toldOf([](Experiment& e) { e.timing.maxMissedTicks = 0; }), "none");
  EXPECT_EQ(toldOf([](Experiment& e) { e.timing.maxMissedTicks = 10'000'000; }), "none");
  EXPECT_NE(toldOf([](Experiment& e) { e.timing.maxMissedTicks = 10'000'001; }), "none");
  EXPECT_EQ(toldOf([](Experiment& e) { e.schemaVersion = 2; }), "schema_version: is 2; allowed: 1, the version that this program reads");
}

TEST(ExperimentValue, AnObjectHasOneTo512MassesAndTheSpringsBetweenThem) {
  const auto withMasses = [](std::size_t count) {
    return toldOf([&](Experiment& e) {
      e.object.masses.assign(count, 0.6);
      e.object.stiffness.assign(count > 0 ? count - 1 : 0, 600);
      e.object.damping.assign(count > 0 ? count - 1 : 0, 0);
    });
  };
  EXPECT_EQ(withMasses(1), "none");
  EXPECT_EQ(withMasses(512), "none");
  EXPECT_EQ(withMasses(513), "object.masses_kg: has 513 elements; allowed: 1 to 512 masses");
  EXPECT_EQ(withMasses(0), "object.masses_kg: has 0 elements; allowed: 1 to 512 masses") << "and nothing of its springs";
  EXPECT_EQ(toldOf([](Experiment& e) { e.object.stiffness.pop_back(); }),
            "object.stiffness_n_per_m: has 3 elements; allowed: an array of 4 numbers");
  EXPECT_EQ(toldOf([](Experiment& e) { e.object.damping.push_back(1); }),
            "object.damping_n_s_per_m: has 5 elements; allowed: an array of 4 numbers");
  EXPECT_EQ(toldOf([](Experiment& e) {
              e.object.kind = ObjectKind::Parallel;
              e.coupling.reset();
              e.object.stiffness.push_back(600);
              e.object.damping.push_back(0);
            }),
            "none")
      << "each mass of a parallel object has a spring";
  EXPECT_TRUE(holds(toldOf([](Experiment& e) { e.object.kind = ObjectKind::Point; }), "object.masses_kg: has 5 elements"));
}

TEST(ExperimentValue, ACouplingBelongsToEveryObjectButAParallelOne) {
  EXPECT_TRUE(holds(toldOf([](Experiment& e) { e.coupling.reset(); }), "coupling: is missing"));
  EXPECT_EQ(toldOf([](Experiment& e) { e.coupling->stiffness = -1, e.coupling->damping = -1; }),
            "coupling.stiffness_n_per_m: is -1; allowed: 0 to 1e+09 N/m\ncoupling.damping_n_s_per_m: is -1; allowed: 0 to 1e+09 N s/m");
}

TEST(ExperimentValue, HandsHoldMassesThatAreThereBySpringsThatHold) {
  const auto with = [](const Hand& hand) { return toldOf([&](Experiment& e) { e.hands = {Hand{1, {100}, {0}, {}}, hand}; }); };
  EXPECT_EQ(with({5, {100}, {0}, {}}), "none");
  EXPECT_EQ(with({0, {0, 0, 0, 0, 1}, {0, 0, 0, 0, 0}, {}}), "none") << "one of its springs is enough";
  EXPECT_EQ(with({6, {100}, {0}, {}}), "hands[1].mass: is 6; allowed: 1 to 5, a mass of the object");
  EXPECT_EQ(with({-1, {100}, {0}, {}}), "hands[1].mass: is -1; allowed: 1 to 5, a mass of the object");
  EXPECT_EQ(with({2, {0}, {3}, {}}),
            "hands[1].stiffness_n_per_m: is 0 throughout: this hand holds nothing; allowed: a stiffness above 0 N/m");
  EXPECT_EQ(with({2, {100}, {-1}, {}}), "hands[1].damping_n_s_per_m[0]: is -1; allowed: 0 to 1e+09 N s/m");
  EXPECT_EQ(with({0, {100}, {0, 0, 0, 0, 0}, {}}), "hands[1].stiffness_n_per_m: has 1 element; allowed: an array of 5 numbers");
  EXPECT_EQ(with({2, {100, 100}, {0}, {}}), "hands[1].stiffness_n_per_m: has 2 elements; allowed: an array of 1 number");
  const auto withMany = [](std::size_t count) { return toldOf([&](Experiment& e) { e.hands.assign(count, Hand{1, {100}, {0}, {}}); }); };
  EXPECT_EQ(withMany(8), "none");
  EXPECT_EQ(withMany(9), "hands: has 9 hands; allowed: up to 8");
}

TEST(ExperimentValue, MethodsAndEstimatorsAreThoseOfTheirLists) {
  for (const std::string& name : methodNames()) EXPECT_EQ(toldOf([&](Experiment& e) { e.method = name; }), "none");
  for (const std::string& name : velocityEstimatorNames())
    EXPECT_EQ(toldOf([&](Experiment& e) { e.velocityEstimator.kind = name; }), "none");
  EXPECT_NE(toldOf([](Experiment& e) { e.method = ""; }), "none");
}

TEST(ExperimentValue, ATaskMovesOnTheCoordinatesOfItsConstraint) {
  EXPECT_EQ(toldOf([](Experiment& e) { e.task.reset(); }), "none") << "nothing need be asked";
  EXPECT_EQ(toldOf([](Experiment& e) { e.task->target.clear(); }),
            "task.target: is missing; allowed: constraint parameters, or three metres when free");
  EXPECT_EQ(toldOf([](Experiment& e) { e.task->target = {1, 2}; }), "task.target: has 2 elements; allowed: an array of 1 number");
  const CompiledExperiment torus = openExperiment("torus"), free = openExperiment("free-body");
  EXPECT_EQ(toldOf([](Experiment& e) { e.task->start = {1}; }, torus), "task.start: has 1 element; allowed: an array of 2 numbers");
  EXPECT_EQ(toldOf([](Experiment& e) { e.task->start = {1, 2}; }, free), "task.start: has 2 elements; allowed: an array of 3 numbers");
  EXPECT_EQ(toldOf([](Experiment& e) { e.task->start = {1, 2, 3}; }, free), "none");
}

TEST(ExperimentValue, ASurfaceBearsOneMassAndOneHand) {
  const auto toldOfObject = [](ObjectKind kind, const std::vector<double>& masses, std::size_t hands) {
    static const CompiledExperiment torus = openExperiment("torus");
    const auto change = [&](Experiment& e) {
      e.object.kind = kind;
      e.object.masses = masses;
      if (kind != ObjectKind::Point) e.object.stiffness = {1}, e.object.damping = {0};
      if (kind == ObjectKind::Parallel) e.coupling.reset();
      e.hands.assign(hands, Hand{1, {100}, {0}, {}});
    };
    return toldOf(change, torus);
  };
  EXPECT_EQ(toldOfObject(ObjectKind::Point, {1}, 0), "none");
  EXPECT_EQ(toldOfObject(ObjectKind::Point, {1}, 2), "hands: hold an object on a surface; allowed: several hands on lines, curves or free");
  EXPECT_EQ(toldOfObject(ObjectKind::Chain, {1, 1}, 0),
            "object.masses_kg: has 2 masses on a surface; allowed: one mass on a surface; chains and parallel objects on curves or free");
  EXPECT_EQ(toldOfObject(ObjectKind::Parallel, {1}, 0), "object.kind: is parallel on a surface; allowed: parallel on curves or free");
}

bool isInertia(double xx, double yy, double zz, double xy, double xz, double yz, double skew = 0) {
  static const CompiledExperiment body = openExperiment("free-body");
  return toldOf([&](Experiment& e) { e.object.inertia = {{{xx, xy, xz}, {xy + skew, yy, yz}, {xz, yz, zz}}}; }, body) == "none";
}

// With ones on the diagonal the determinant is 1 + 2abc - a^2 - b^2 - c^2, which is 0 where c = ab +- sqrt((1 - a^2)(1 - b^2)).
TEST(ExperimentValue, AnInertiaIsASymmetricPositiveMatrix) {
  EXPECT_TRUE(isInertia(1, 2, 3, 0, 0, 0));
  const double s[3] = {2, 0.5, 3};  // the axes in units of their own
  const auto scaled = [&](double a, double b, double c) {
    return isInertia(s[0] * s[0], s[1] * s[1], s[2] * s[2], s[0] * s[1] * a, s[0] * s[2] * b, s[1] * s[2] * c);
  };
  for (const auto& [a, b] : {std::pair{0.6, 0.5}, std::pair{-0.6, 0.5}, std::pair{0.6, -0.8}, std::pair{0.3, 0.0}, std::pair{0.0, 0.3}}) {
    const double middle = a * b, half = std::sqrt((1 - a * a) * (1 - b * b));
    for (const double end : {-1.0, 1.0}) {
      for (const double inside : {0.0, 0.5, 0.999}) EXPECT_TRUE(scaled(a, b, middle + end * inside * half)) << a << " " << b << " " << end;
      for (const double outside : {1.001, 1.5, 4.0})
        EXPECT_FALSE(scaled(a, b, middle + end * outside * half)) << a << " " << b << " " << end;
    }
  }
  EXPECT_TRUE(scaled(0.999, 0, 0));
  EXPECT_FALSE(scaled(1.001, 0, 0));
  EXPECT_FALSE(isInertia(0, 1, 1, 0, 0, 0));
  EXPECT_FALSE(isInertia(1, 0, 1, 0, 0, 0));
  EXPECT_FALSE(isInertia(1, 1, 0, 0, 0, 0));
  EXPECT_FALSE(isInertia(-1, -1, 1, 0, 0, 0)) << "of positive determinant";
  EXPECT_FALSE(isInertia(1, -1, -1, 0, 0, 0));
  EXPECT_FALSE(isInertia(-1, 1, -1, 0, 0, 0));
  EXPECT_FALSE(isInertia(1, 1, 1, 0, 0, 0, 0.1)) << "of no symmetry";
  EXPECT_FALSE(isInertia(1, 1, 1, 2, 2, 2));
}

TEST(ExperimentValue, AnInertiaIsOfFiniteNumbersInARowEach) {
  const CompiledExperiment body = openExperiment("free-body");
  EXPECT_EQ(toldOf([](Experiment& e) { e.object.inertia[1][2] = std::nan(""); }, body),
            "object.inertia_kg_m2[1][2]: is nan; allowed: -1e+09 to 1e+09");
  EXPECT_EQ(toldOf([](Experiment& e) { e.object.fpOffset.y = std::nan(""); }, body),
            "object.fp_offset_m[1]: is nan; allowed: -1e+09 to 1e+09");
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const auto change = [&](Experiment& e) {
        e.object.inertia = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        e.object.inertia[row][column] += 0.01;
      };
      EXPECT_EQ(toldOf(change, body) == "none", row == column) << row << column;
    }
}

TEST(ExperimentValue, ThePlacesInUseAreTheHullOfStartAndTarget) {
  Task task;
  task.start = {3, -1}, task.target = {-2, 5};
  const auto both = placesInUse(task);
  ASSERT_TRUE(both);
  EXPECT_EQ((*both)[0].lo, -2);
  EXPECT_EQ((*both)[0].hi, 3);
  EXPECT_EQ((*both)[1].lo, -1);
  EXPECT_EQ((*both)[1].hi, 5);
  task.start = {2}, task.target = {7};
  EXPECT_EQ(placesInUse(task)->at(0).hi, 7);
  EXPECT_EQ(placesInUse(task)->at(1).lo, 0);
  EXPECT_EQ(placesInUse(task)->at(1).hi, 0);
  EXPECT_FALSE(placesInUse(std::nullopt));
  task.start = {2, 3};
  EXPECT_FALSE(placesInUse(task)) << "of two lengths";
  task.start = {1, 2, 3}, task.target = {4, 5, 6};
  EXPECT_FALSE(placesInUse(task)) << "metres in space";
  task.start.clear(), task.target.clear();
  EXPECT_FALSE(placesInUse(task));
  task.start = {std::nan("")}, task.target = {1};
  EXPECT_FALSE(placesInUse(task));
  std::swap(task.start, task.target);
  EXPECT_FALSE(placesInUse(task));
}

TEST(ExperimentValue, WithoutATaskSaysThatATrialNeedsOne) {
  Experiment e = chain().experiment();
  EXPECT_EQ(requiredTask(e).duration, 1.35);
  e.task.reset();
  EXPECT_EQ(refusalOf([&] { (void)requiredTask(e); }),
            "task: is missing, and a trial needs one; allowed: { start, target, duration_s, … }");
}

}  // namespace
}  // namespace reachlab::experiment
