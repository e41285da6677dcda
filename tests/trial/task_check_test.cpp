#include "sim/trial/task_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "sim/experiment/experiment.h"
#include "sim/trial/protocol.h"
#include "tests/refusal.h"

namespace reachlab::trial {
namespace {

// A line for each fault: its key, and what is wrong there.
std::string told(const std::vector<Fault>& faults) {
  std::string lines;
  for (const Fault& fault : faults) lines += (lines.empty() ? "" : "\n") + fault.key + ": " + fault.what;
  return lines;
}

std::vector<Fault> implausibleWith(const std::string& name, const std::function<void(experiment::Experiment&)>& change) {
  experiment::Experiment e = experiment::readExperiment(name);
  change(e);
  return implausibleNumbers(experiment::CompiledExperiment(e));
}

std::vector<Fault> problemsWith(const std::string& name, const std::function<void(experiment::Experiment&)>& change) {
  experiment::Experiment e = experiment::readExperiment(name);
  change(e);
  return taskProblems(experiment::CompiledExperiment(e));
}

TEST(TaskCheck, RefusesViaPointsBesideAConstraintWithoutEnds) {
  for (const char* name : {"chain-moderate", "helix"})
    for (const double beside : {0.0, 0.2}) {
      const auto found = problemsWith(name, [&](auto& e) {
        const experiment::CompiledExperiment there(e);
        e.task->via = {makeProtocolSettings(e, there.constraint()).target + Vec3{0, beside, beside}};
      });
      EXPECT_EQ(found.size(), beside > 0 ? 1u : 0u) << name;
    }
}

TEST(TaskCheck, TakesAViaPointFarBehindTheTarget) {
  EXPECT_TRUE(problemsWith("chain-moderate",
                           [](auto& e) {
                             const Vec3 start = makeProtocolSettings(e, experiment::CompiledExperiment(e).constraint()).start;
                             e.task->target[0] = e.task->start[0] + 0.1 * (e.task->target[0] - e.task->start[0]);
                             e.task->via = {start + Vec3{0.2, 0, 0}};
                           })
                  .empty())
      << "out and back";
}

TEST(TaskCheck, RefusesAWayThatStaysAtThePole) {
  const auto between = [](double first, double second) {
    return problemsWith("sphere", [&](auto& e) {
      e.task->start = {0, first};
      e.task->target = {1, second};
    });
  };
  constexpr double kPole = std::numbers::pi / 2;
  ASSERT_EQ(between(kPole, kPole).size(), 1u);
  EXPECT_EQ(between(kPole, kPole)[0].what, "start and target are the same position");
  EXPECT_TRUE(between(kPole, 0).empty());
}

TEST(TaskCheck, TellsOfPulsesThatNeverCome) {
  const auto pulseAt = [](experiment::PulseInstant at) {
    return implausibleWith("centre-out", [&](auto& e) { e.environment = {{experiment::PulseForce{{3, 0, 0}, at}}}; });
  };
  EXPECT_TRUE(pulseAt({.onset = 0.1, .distance = {}}).empty());
  EXPECT_TRUE(pulseAt({.onset = {}, .distance = 0.05}).empty());
  for (const auto& [at, key] : {std::pair{experiment::PulseInstant{.onset = 10, .distance = {}}, "environment[0].at.onset_s"},
                                {experiment::PulseInstant{.onset = {}, .distance = 0.5}, "environment[0].at.distance_m"}})
    EXPECT_EQ(keysTold(pulseAt(at)), key);
}

TEST(TaskCheck, TellsOfMassesAndTimesThatAreHardlyMeant) {
  EXPECT_TRUE(implausibleWith("chain-moderate", [](auto&) {}).empty());
  EXPECT_TRUE(implausibleWith("chain-moderate", [](auto& e) { e.object.masses[0] = e.object.masses[1] = 100; }).empty());
  const auto heavy = implausibleWith("chain-moderate", [](auto& e) { e.object.masses[0] = 100.5, e.object.masses[2] = 250; });
  EXPECT_EQ(told(heavy),
            "object.masses_kg[0]: is 100.5 kg; more than 100 kg is hardly meant\n"
            "object.masses_kg[2]: is 250 kg; more than 100 kg is hardly meant");
  EXPECT_TRUE(implausibleWith("chain-moderate", [](auto& e) { e.task->duration = 60; }).empty());
  EXPECT_EQ(told(implausibleWith("chain-moderate", [](auto& e) { e.task->duration = 60.5; })),
            "task.duration_s: is 60.5 s; more than 60 s is hardly meant");
  EXPECT_TRUE(implausibleWith("epitrochoid", [](auto& e) { e.task->target[0] = e.task->start[0] + 2 * std::numbers::pi; }).empty())
      << "a lap";
  const auto turns = implausibleWith("epitrochoid", [](auto& e) { e.task->target[0] = e.task->start[0] - 12 * std::numbers::pi; });
  EXPECT_EQ(told(turns), "task.target[0]: is 6 turns from the start; more than one turn is hardly meant");
  EXPECT_EQ(told(implausibleWith("chain-moderate", [](auto& e) { e.task->duration = 0.03; })),
            "task.duration_s: is 0.03 s for a way of 0.2 m, which needs 12.5 m/s; more than 10 m/s is hardly meant");
  EXPECT_EQ(implausibleWith("chain-moderate", [](auto& e) { e.task.reset(), e.object.masses[0] = 101; }).size(), 1u)
      << "a task is not needed";
}

TEST(TaskCheck, TellsOfAnElasticFieldThatPushesAway) {
  const auto told = [](const experiment::SquareMatrix<3>& k) {
    return implausibleWith("chain-moderate", [&](auto& e) { e.environment = {{experiment::ElasticForce{k, {}}}}; }).size();
  };
  EXPECT_EQ(told({{{100, 0, 0}, {0, 0, 0}, {0, 0, 100}}}), 0u) << "a direction without a spring is held by nothing and pushed by nothing";
  EXPECT_EQ(told({{{100, 80, 0}, {-80, 100, 0}, {0, 0, 0}}}), 0u) << "only the symmetric part pushes";
  EXPECT_EQ(told({{{-1, 0, 0}, {0, 100, 0}, {0, 0, 100}}}), 1u);
  EXPECT_EQ(told({{{10, 20, 0}, {20, 10, 0}, {0, 0, 10}}}), 1u) << "10 - 20 along the diagonal";
  EXPECT_EQ(told({{{10, 8, 8}, {8, 10, -8}, {8, -8, 10}}}), 1u) << "each plane holds, and all three together do not: 10 - 16";
}

// A full lap of a circle is a way, though the chord is none; on a surface the chord counts.
TEST(TaskCheck, TellsOfAToleranceLargerThanTheWay) {
  const auto onCircle = [](double tolerance) {
    return implausibleWith("ellipse", [&](auto& e) {
      e.constraint = {.name = {}, .curve = {"0.1*cos(phi)", "0.1*sin(phi)", "0"}, .surface = {}, .shape = {}};
      e.task->start = {0}, e.task->target = {2 * std::numbers::pi};
      e.task->tolerance.position = tolerance;
    });
  };
  EXPECT_TRUE(onCircle(0.628).empty());
  EXPECT_EQ(told(onCircle(0.629)), "task.tolerance.position_m: is 0.629 m, more than the way of 0.6283 m from start to target");
  const auto onSurface = [](double tolerance) {
    return implausibleWith("torus", [&](auto& e) {
      e.constraint = {.name = {}, .curve = {}, .surface = {"u", "v", "0"}, .shape = {}};
      e.task->start = {0.5, 0.25}, e.task->target = {0.2, 0.65};
      e.task->tolerance.position = tolerance;
    });
  };
  EXPECT_TRUE(onSurface(0.499).empty());
  EXPECT_EQ(onSurface(0.501).size(), 1u);
}

TEST(TaskCheck, TellsOfAnOnsetThatIsNoShorterThanTheWay) {
  EXPECT_TRUE(implausibleWith("chain-moderate", [](auto& e) { e.task->onset = 0.199; }).empty());
  EXPECT_EQ(keysTold(implausibleWith("chain-moderate", [](auto& e) { e.task->onset = 0.201; })), "task.onset_m");
}

// A cycloid has two ends.
TEST(TaskCheck, NeedsATargetOnTheCurve) {
  const auto target = [](double phi) {
    return problemsWith("ellipse", [&](auto& e) { e.constraint = {.name = "cycloid"}, e.task->start = {1}, e.task->target = {phi}; });
  };
  EXPECT_TRUE(target(2 * std::numbers::pi).empty());
  ASSERT_EQ(target(8).size(), 1u);
  EXPECT_EQ(target(8)[0].what, "is 8, beyond an end of the curve");
  EXPECT_EQ(target(-0.1).size(), 1u);
}

// The helicoid ends at v = 1. A sphere goes on behind its pole at v = pi/2, and a torus has no ends.
TEST(TaskCheck, NeedsATargetOnTheSurface) {
  const auto problems = [](const char* name, std::vector<double> start, std::vector<double> target) {
    return problemsWith("torus", [&](auto& e) {
      e.constraint = {.name = name};
      e.task->start = std::move(start), e.task->target = std::move(target);
    });
  };
  EXPECT_EQ(keysTold(problems("helicoid", {-1.5, 0.6}, {1, 1.5})), "task.target[1]");
  EXPECT_TRUE(problems("helicoid", {-1.5, 0.6}, {1, 1}).empty());
  EXPECT_TRUE(problems("sphere", {0, 1}, {0, 2}).empty());
  EXPECT_TRUE(problems("torus", {0, 0.5}, {0, 6.5}).empty());
}

TEST(TaskCheck, WarnsOfASpringThatHoldsNothing) {
  const auto found = implausibleWith("chain-moderate", [](auto& e) { e.coupling->stiffness = 0, e.object.stiffness[2] = 0; });
  EXPECT_EQ(keysTold(found), "coupling.stiffness_n_per_m object.stiffness_n_per_m[2]");
}

TEST(TaskCheck, NeedsATaskBetweenTwoPlaces) {
  EXPECT_TRUE(problemsWith("chain-moderate", [](auto&) {}).empty());
  EXPECT_EQ(told(problemsWith("chain-moderate", [](auto& e) { e.task.reset(); })), "task: is missing, and a run needs one");
  EXPECT_EQ(told(problemsWith("chain-moderate", [](auto& e) { e.task->target = e.task->start; })),
            "task.target: start and target are the same position");
  EXPECT_TRUE(problemsWith("ellipse", [](auto& e) { e.task->start = {0}, e.task->target = {2 * std::numbers::pi}; }).empty()) << "a lap";
  experiment::Experiment e = experiment::readExperiment("chain-moderate");
  e.task->target = e.task->start;
  EXPECT_THROW(checkTask(experiment::CompiledExperiment(e), "x.json"), FaultError);
  EXPECT_NO_THROW(checkTask(experiment::CompiledExperiment(experiment::readExperiment("chain-moderate")), "x.json"));
}

}  // namespace
}  // namespace reachlab::trial
