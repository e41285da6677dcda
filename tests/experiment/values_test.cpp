// What an experiment's value is: defaults, every key of its file, every bound, every difference.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/equality.h"

namespace reachlab::experiment {
namespace {

const CompiledExperiment& chain() {
  static const CompiledExperiment compiled = openExperiment("chain-moderate");
  return compiled;
}

std::vector<Fault> faultsOf(const Experiment& e, const CompiledExperiment& compiled = chain()) {
  return check(e, &compiled.constraint()).faults;
}

struct Bound {
  const char* key;
  std::function<void(Experiment&, double)> set;
  double least, most;
  bool withLeast;
  const char* allowed;
};

TEST(ExperimentValue, EveryNumberReachesToItsBoundsAndNoFurther) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const std::vector<Bound> bounds{
      {"object.masses_kg[4]", [](Experiment& e, double x) { e.object.masses[4] = x; }, 0, kLargest, false, "more than 0 kg"},
      {"object.stiffness_n_per_m[3]", [](Experiment& e, double x) { e.object.stiffness[3] = x; }, 0, kLargest, true, "0 N/m or more"},
      {"object.damping_n_s_per_m[1]", [](Experiment& e, double x) { e.object.damping[1] = x; }, 0, kLargest, true, "0 N s/m or more"},
      {"object.viscosity_n_s_per_m", [](Experiment& e, double x) { e.object.viscosity = x; }, 0, kLargest, true, "0 N s/m or more"},
      {"object.gravity_m_per_s2[2]", [](Experiment& e, double x) { e.object.gravity.z = x; }, -kLargest, kLargest, true,
       "any finite number"},
      {"coupling.stiffness_n_per_m", [](Experiment& e, double x) { e.coupling->stiffness = x; }, 0, kLargest, true, "0 N/m or more"},
      {"coupling.damping_n_s_per_m", [](Experiment& e, double x) { e.coupling->damping = x; }, 0, kLargest, true, "0 N s/m or more"},
      {"task.start[0]", [](Experiment& e, double x) { e.task->start[0] = x; }, -kLargest, kLargest, true, "any finite number"},
      {"task.duration_s", [](Experiment& e, double x) { e.task->duration = x; }, 0, 3600, false, "more than 0 s, at most 3600 s"},
      {"task.tolerance.position_m", [](Experiment& e, double x) { e.task->tolerance.position = x; }, 0, kLargest, false, "more than 0 m"},
      {"task.tolerance.velocity_m_per_s", [](Experiment& e, double x) { e.task->tolerance.velocity = x; }, 0, kLargest, false,
       "more than 0 m/s"},
      {"task.tolerance.time_s", [](Experiment& e, double x) { e.task->tolerance.time = x; }, 0, 3600, false,
       "more than 0 s, at most 3600 s"},
      {"task.onset_m", [](Experiment& e, double x) { e.task->onset = x; }, 0, kLargest, false, "more than 0 m"},
      {"task.arm_radius_m", [](Experiment& e, double x) { e.task->armRadius = x; }, 0, kLargest, false, "more than 0 m"},
      {"task.timeout_s", [](Experiment& e, double x) { e.task->timeout = x; }, 0, 86400, false, "more than 0 s, at most 86400 s"},
      {"task.rest_s", [](Experiment& e, double x) { e.task->rest.seconds = x; }, 0, 60, true, "0 to 60 s"},
      {"task.rest_speed_m_per_s", [](Experiment& e, double x) { e.task->rest.speed = x; }, 0, kLargest, false, "more than 0 m/s"},
      {"hand_mass_kg", [](Experiment& e, double x) { e.handMass = x; }, 0, kLargest, true, "0 kg or more"},
      {"force_limit_n", [](Experiment& e, double x) { e.forceLimit = x; }, 0, kLargest, false, "more than 0 N"},
      {"timing.max_gap_s", [](Experiment& e, double x) { e.timing.maxGap = x; }, 0.001, 7200, true, "0.001 s to 7200 s"},
      {"velocity_estimator.cutoff_hz", [](Experiment& e, double x) { e.velocityEstimator.cutoff = x; }, 0, 400, false,
       "more than 0 Hz, at most 400 Hz"},
      {"arm.link_length_m[0]", [](Experiment& e, double x) { e.arm.length[0] = x; }, 0, kLargest, false, "more than 0 m"},
      {"arm.link_length_m[1]", [](Experiment& e, double x) { e.arm.length[1] = x; }, 0, kLargest, false, "more than 0 m"},
      {"arm.link_centre_m[0]", [](Experiment& e, double x) { e.arm.centre[0] = x; }, 0, kLargest, false, "more than 0 m"},
      {"arm.link_centre_m[1]", [](Experiment& e, double x) { e.arm.centre[1] = x; }, 0, kLargest, false, "more than 0 m"},
      {"arm.link_mass_kg[0]", [](Experiment& e, double x) { e.arm.mass[0] = x; }, 0, kLargest, false, "more than 0 kg"},
      {"arm.link_inertia_kg_m2[0]", [](Experiment& e, double x) { e.arm.inertia[0] = x; }, 0, kLargest, false, "more than 0 kg m^2"},
      {"arm.link_inertia_kg_m2[1]", [](Experiment& e, double x) { e.arm.inertia[1] = x; }, 0, kLargest, false, "more than 0 kg m^2"},
      {"arm.joint_damping_n_m_s_per_rad[0]", [](Experiment& e, double x) { e.arm.damping[0] = x; }, 0, kLargest, true,
       "0 N m s/rad or more"},
      {"arm.joint_damping_n_m_s_per_rad[1]", [](Experiment& e, double x) { e.arm.damping[1] = x; }, 0, kLargest, true,
       "0 N m s/rad or more"},
      {"arm.shoulder_m[1]", [](Experiment& e, double x) { e.arm.shoulder[1] = x; }, -kLargest, kLargest, true, "any finite number"}};
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Bound& b : bounds) {
    const auto with = [&](double x) {
      Experiment e = chain().experiment();
      b.set(e, x);
      return faultsOf(e);
    };
    for (const double good : {b.withLeast ? b.least : std::nextafter(b.least, infinity), b.most})
      EXPECT_TRUE(with(good).empty()) << b.key << good;
    for (const double bad : {b.withLeast ? std::nextafter(b.least, -infinity) : b.least, std::nextafter(b.most, infinity), std::nan("")}) {
      const std::vector<Fault> faults = with(bad);
      ASSERT_EQ(faults.size(), 1u) << b.key << " " << bad;
      EXPECT_EQ(faults[0].key, b.key);
      EXPECT_EQ(faults[0].allowed, b.allowed);
    }
  }
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
  EXPECT_NE(toldOf([](Experiment& e) { e.object.kind = ObjectKind::Point; }).find("object.masses_kg: has 5 elements"), std::string::npos);
}

TEST(ExperimentValue, ACouplingBelongsToEveryObjectButAParallelOne) {
  EXPECT_NE(toldOf([](Experiment& e) { e.coupling.reset(); }).find("coupling: is missing"), std::string::npos);
  EXPECT_EQ(toldOf([](Experiment& e) { e.coupling->stiffness = -1, e.coupling->damping = -1; }),
            "coupling.stiffness_n_per_m: is -1; allowed: 0 N/m or more\ncoupling.damping_n_s_per_m: is -1; allowed: 0 N s/m or more");
}

TEST(ExperimentValue, HandsHoldMassesThatAreThereBySpringsThatHold) {
  const auto with = [](const Hand& hand) { return toldOf([&](Experiment& e) { e.hands = {Hand{1, {100}, {0}, {}}, hand}; }); };
  EXPECT_EQ(with({5, {100}, {0}, {}}), "none");
  EXPECT_EQ(with({0, {0, 0, 0, 0, 1}, {0, 0, 0, 0, 0}, {}}), "none") << "one of its springs is enough";
  EXPECT_EQ(with({6, {100}, {0}, {}}), "hands[1].mass: is 6; allowed: 1 to 5, a mass of the object");
  EXPECT_EQ(with({-1, {100}, {0}, {}}), "hands[1].mass: is -1; allowed: 1 to 5, a mass of the object");
  EXPECT_EQ(with({2, {0}, {3}, {}}),
            "hands[1].stiffness_n_per_m: is 0 throughout: this hand holds nothing; allowed: a stiffness above 0 N/m");
  EXPECT_EQ(with({2, {100}, {-1}, {}}), "hands[1].damping_n_s_per_m[0]: is -1; allowed: 0 N s/m or more");
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
  const CompiledExperiment torus = openExperiment("torus");
  EXPECT_EQ(toldOf(
                [](Experiment& e) {
                  e.hands = {Hand{1, {100}, {0}, {}}, Hand{1, {100}, {0}, {}}};
                },
                torus),
            "hands: hold an object on a surface; allowed: several hands on lines, curves or free");
  EXPECT_EQ(toldOf(
                [](Experiment& e) {
                  e.object.kind = ObjectKind::Chain;
                  e.object.masses = {1, 1}, e.object.stiffness = {1}, e.object.damping = {0};
                },
                torus),
            "object.masses_kg: has 2 masses on a surface; allowed: one mass on a surface; chains and parallel objects on curves or free");
  EXPECT_EQ(toldOf(
                [](Experiment& e) {
                  e.object.kind = ObjectKind::Parallel;
                  e.object.masses = {1}, e.object.stiffness = {1}, e.object.damping = {0};
                  e.coupling.reset();
                },
                torus),
            "object.kind: is parallel on a surface; allowed: parallel on curves or free");
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
            "object.inertia_kg_m2[1][2]: is nan; allowed: any finite number");
  EXPECT_EQ(toldOf([](Experiment& e) { e.object.fpOffset.y = std::nan(""); }, body),
            "object.fp_offset_m[1]: is nan; allowed: any finite number");
  for (const auto& [row, column] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}, std::pair{1, 0}, std::pair{2, 0}, std::pair{2, 1}})
    EXPECT_NE(toldOf(
                  [&, r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column)](Experiment& e) {
                    e.object.inertia = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
                    e.object.inertia[r][c] = 0.01;
                  },
                  body),
              "none")
        << row << column;
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
  try {
    (void)requiredTask(e);
    FAIL();
  } catch (const FaultError& refusal) {
    EXPECT_STREQ(refusal.what(), "task: is missing, and a trial needs one; allowed: { start, target, duration_s, … }");
  }
}

const std::string kLeast = R"({ "schema_version": 1, "constraint": { "name": "line" },
  "object": { "kind": "chain", "masses_kg": [1, 2, 3], "stiffness_n_per_m": [10, 20] }, "coupling": { "stiffness_n_per_m": 600 },
  "task": { "start": [0], "target": [1], "duration_s": 1, "tolerance": { "position_m": 1, "velocity_m_per_s": 2, "time_s": 3 } } })";

TEST(ExperimentFile, WhatItDoesNotSayHasTheDocumentedDefaults) {
  const Experiment e = parseExperiment(kLeast, "least.json");
  EXPECT_EQ(e.object.damping, (std::vector<double>{0, 0}));
  EXPECT_EQ(e.object.viscosity, 0);
  EXPECT_EQ(e.object.gravity, Vec3{});
  EXPECT_EQ(e.coupling->damping, 0);
  EXPECT_TRUE(e.hands.empty());
  EXPECT_EQ(e.task->onset, 0.001);
  EXPECT_EQ(e.task->armRadius, 0.01);
  EXPECT_EQ(e.task->timeout, 10);
  EXPECT_EQ(e.task->rest.seconds, 0.3);
  EXPECT_EQ(e.task->rest.speed, 0.02);
  EXPECT_EQ(e.method, "auto");
  EXPECT_EQ(e.handMass, 0);
  EXPECT_FALSE(e.forceLimit);
  EXPECT_FALSE(e.forceLimitEndsTrial);
  EXPECT_EQ(e.timing.maxMissedTicks, 5);
  EXPECT_EQ(e.timing.maxGap, 0.02);
  EXPECT_EQ(e.velocityEstimator.kind, "auto");
  EXPECT_EQ(e.velocityEstimator.cutoff, 40);
  using Pair = std::array<double, 2>;
  EXPECT_EQ(e.arm.length, (Pair{0.25, 0.35}));
  EXPECT_EQ(e.arm.centre, (Pair{0.11, 0.15}));
  EXPECT_EQ(e.arm.mass, (Pair{0.9, 1.1}));
  EXPECT_EQ(e.arm.inertia, (Pair{0.065, 0.1}));
  EXPECT_EQ(e.arm.damping, (Pair{0.08, 0.08}));
  EXPECT_EQ(e.arm.shoulder, (Pair{0, -0.45}));
  EXPECT_FALSE(e.arm.elbowLeft);
  EXPECT_EQ(e.subjectScreen, SubjectScreen{});
  for (const bool shown : {e.subjectScreen.semaphore, e.subjectScreen.target, e.subjectScreen.masses, e.subjectScreen.words})
    EXPECT_TRUE(shown);
  EXPECT_FALSE(e.subjectScreen.score || e.subjectScreen.photodiode);
}

TEST(ExperimentValue, BeginsWithTheDocumentedDefaults) {
  const Task task;
  EXPECT_EQ(task.duration, 1.35);
  EXPECT_EQ(task.tolerance.position, 0.012);
  EXPECT_EQ(task.tolerance.velocity, 0.012);
  EXPECT_EQ(task.tolerance.time, 0.5);
  EXPECT_EQ(Hand{}.mass, 1);
  EXPECT_EQ(Coupling{}.stiffness + Coupling{}.damping, 0);
  EXPECT_EQ(Experiment{}.schemaVersion, 1);
  EXPECT_EQ(kNoStartRest.seconds, 0);
  EXPECT_EQ(kNoStartRest.speed, 1000);
  EXPECT_EQ(kNoTimingLimits.maxMissedTicks, 10'000'000);
  EXPECT_EQ(kNoTimingLimits.maxGap, 7200);
}

// Every value another one than its default, and no two the same.
const std::string kFull = R"({ "schema_version": 1, "name": "full", "description": "all keys",
  "constraint": { "name": "line", "shape": { "length_m": 0.3 } },
  "object": { "kind": "chain", "masses_kg": [1, 2, 3], "stiffness_n_per_m": [10, 20], "damping_n_s_per_m": [0.1, 0.2],
              "viscosity_n_s_per_m": 0.3, "gravity_m_per_s2": [0.4, -9.8, 0.5] },
  "coupling": { "stiffness_n_per_m": 601, "damping_n_s_per_m": 0.6 },
  "hands": [ {}, { "mass": 3, "stiffness_n_per_m": 31, "damping_n_s_per_m": 0.7 },
             { "stiffness_n_per_m": [41, 42, 43] }, { "stiffness_n_per_m": [41, 42, 43], "damping_n_s_per_m": [4, 5, 6] } ],
  "task": { "start": [0.5], "target": [1.5], "duration_s": 1.25,
            "tolerance": { "position_m": 0.013, "velocity_m_per_s": 0.014, "time_s": 0.15 },
            "onset_m": 0.002, "arm_radius_m": 0.016, "timeout_s": 17, "rest_s": 0.18, "rest_speed_m_per_s": 0.19 },
  "method": "abm", "hand_mass_kg": 1.75, "force_limit_n": 8, "force_limit_ends_trial": true,
  "timing": { "max_missed_ticks": 9, "max_gap_s": 0.021 }, "velocity_estimator": { "kind": "butterworth", "cutoff_hz": 55 },
  "arm": { "link_length_m": [0.31, 0.32], "link_centre_m": [0.33, 0.34], "link_mass_kg": [0.35, 0.36], "link_inertia_kg_m2": [0.37, 0.38],
           "joint_damping_n_m_s_per_rad": [0.39, 0.41], "shoulder_m": [0.42, 0.43], "elbow_left": true },
  "subject_screen": { "semaphore": false, "target": false, "masses": false, "words": false, "score": true, "photodiode": true } })";

TEST(ExperimentFile, EveryKeyGoesToItsPlace) {
  const Experiment e = parseExperiment(kFull, "x.json");
  EXPECT_EQ(e.name, "full");
  EXPECT_EQ(e.constraint.shape.at("length_m"), 0.3);
  EXPECT_EQ(e.object.damping, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(e.object.viscosity, 0.3);
  EXPECT_EQ(e.object.gravity, (Vec3{0.4, -9.8, 0.5}));
  EXPECT_EQ(e.coupling->damping, 0.6);
  ASSERT_EQ(e.hands.size(), 4u);
  EXPECT_EQ(e.hands[0].mass, 1);
  EXPECT_EQ(e.hands[0].stiffness, std::vector<double>{601}) << "by the coupling";
  EXPECT_EQ(e.hands[0].damping, std::vector<double>{0.6});
  EXPECT_EQ(e.hands[1].mass, 3);
  EXPECT_EQ(e.hands[1].stiffness, std::vector<double>{31});
  EXPECT_EQ(e.hands[1].damping, std::vector<double>{0.7});
  EXPECT_EQ(e.hands[2].mass, 0) << "all of them";
  EXPECT_EQ(e.hands[2].stiffness, (std::vector<double>{41, 42, 43}));
  EXPECT_EQ(e.hands[2].damping, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(e.hands[3].damping, (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(e.task->start, std::vector<double>{0.5});
  EXPECT_EQ(e.task->tolerance.velocity, 0.014);
  EXPECT_EQ(e.task->onset, 0.002);
  EXPECT_EQ(e.task->armRadius, 0.016);
  EXPECT_EQ(e.task->timeout, 17);
  EXPECT_EQ(e.task->rest.seconds, 0.18);
  EXPECT_EQ(e.task->rest.speed, 0.19);
  EXPECT_EQ(e.method, "abm");
  EXPECT_EQ(e.handMass, 1.75);
  EXPECT_EQ(e.forceLimit, 8);
  EXPECT_TRUE(e.forceLimitEndsTrial);
  EXPECT_EQ(e.timing.maxMissedTicks, 9);
  EXPECT_EQ(e.velocityEstimator.kind, "butterworth");
  EXPECT_EQ(e.velocityEstimator.cutoff, 55);
  EXPECT_EQ(e.arm.mass, (std::array<double, 2>{0.35, 0.36}));
  EXPECT_EQ(e.arm.shoulder, (std::array<double, 2>{0.42, 0.43}));
  EXPECT_TRUE(e.arm.elbowLeft);
  EXPECT_EQ(e.subjectScreen, (SubjectScreen{false, false, false, false, true, true}));
  EXPECT_EQ(parseExperiment(R"({"schema_version": 1, "constraint": {"name": "line"}, "object": {"kind": "point", "masses_kg": [1]},
                                "coupling": {"stiffness_n_per_m": 1}, "velocity_estimator": "kalman"})",
                            "x.json")
                .velocityEstimator.kind,
            "kalman");
  Experiment again = parseExperiment(toJson(e), "x.json");
  EXPECT_EQ(toJson(again), toJson(e));
  again.text = e.text;
  EXPECT_TRUE(again == e) << "what is written reads back equal";
}

TEST(ExperimentValue, IsAnotherWhereAnythingOfItIs) {
  const Experiment full = parseExperiment(kFull, "x.json");
  const std::vector<std::function<void(Experiment&)>> changes{[](Experiment& e) { ++e.schemaVersion; },
                                                              [](Experiment& e) { e.name += "x"; },
                                                              [](Experiment& e) { e.constraint.shape["length_m"] = 1; },
                                                              [](Experiment& e) { e.object.kind = ObjectKind::Point; },
                                                              [](Experiment& e) { e.object.masses[1] += 1; },
                                                              [](Experiment& e) { e.object.stiffness[0] += 1; },
                                                              [](Experiment& e) { e.object.damping.clear(); },
                                                              [](Experiment& e) { e.object.viscosity += 1; },
                                                              [](Experiment& e) { e.object.gravity.x += 1; },
                                                              [](Experiment& e) { e.object.inertia[1][2] = 1; },
                                                              [](Experiment& e) { e.object.fpOffset.z = 1; },
                                                              [](Experiment& e) { e.coupling->stiffness += 1; },
                                                              [](Experiment& e) { e.coupling->damping += 1; },
                                                              [](Experiment& e) { e.coupling.reset(); },
                                                              [](Experiment& e) { e.hands.pop_back(); },
                                                              [](Experiment& e) { e.hands[1].mass = 2; },
                                                              [](Experiment& e) { e.hands[1].stiffness[0] += 1; },
                                                              [](Experiment& e) { e.hands[3].damping[2] += 1; },
                                                              [](Experiment& e) { e.hands[0].fpOffset.y += 1; },
                                                              [](Experiment& e) { e.task.reset(); },
                                                              [](Experiment& e) { e.task->start[0] += 1; },
                                                              [](Experiment& e) { e.task->target[0] += 1; },
                                                              [](Experiment& e) { e.task->duration += 1; },
                                                              [](Experiment& e) { e.task->tolerance.position += 1; },
                                                              [](Experiment& e) { e.task->tolerance.velocity += 1; },
                                                              [](Experiment& e) { e.task->tolerance.time += 1; },
                                                              [](Experiment& e) { e.task->onset += 1; },
                                                              [](Experiment& e) { e.task->armRadius += 1; },
                                                              [](Experiment& e) { e.task->timeout += 1; },
                                                              [](Experiment& e) { e.task->rest.seconds += 1; },
                                                              [](Experiment& e) { e.task->rest.speed += 1; },
                                                              [](Experiment& e) { e.method = "rk4"; },
                                                              [](Experiment& e) { e.handMass += 1; },
                                                              [](Experiment& e) { e.forceLimit.reset(); },
                                                              [](Experiment& e) { e.forceLimitEndsTrial = false; },
                                                              [](Experiment& e) { ++e.timing.maxMissedTicks; },
                                                              [](Experiment& e) { e.timing.maxGap += 1; },
                                                              [](Experiment& e) { e.velocityEstimator.kind = "auto"; },
                                                              [](Experiment& e) { e.velocityEstimator.cutoff += 1; },
                                                              [](Experiment& e) { e.arm.length[1] += 1; },
                                                              [](Experiment& e) { e.arm.centre[0] += 1; },
                                                              [](Experiment& e) { e.arm.mass[1] += 1; },
                                                              [](Experiment& e) { e.arm.inertia[0] += 1; },
                                                              [](Experiment& e) { e.arm.damping[1] += 1; },
                                                              [](Experiment& e) { e.arm.shoulder[0] += 1; },
                                                              [](Experiment& e) { e.arm.elbowLeft = false; },
                                                              [](Experiment& e) { e.subjectScreen.score = false; },
                                                              [](Experiment& e) { e.text += " "; }};
  EXPECT_TRUE(full == full);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Experiment changed = full;
    changes[i](changed);
    EXPECT_FALSE(full == changed) << i;
    EXPECT_FALSE(changed == full) << i;
  }
}

}  // namespace
}  // namespace reachlab::experiment
