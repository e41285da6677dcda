#include "sim/trial/task_places.h"

#include <gtest/gtest.h>

#include "sim/experiment/experiment.h"

namespace reachlab::trial {
namespace {

// A crease along v = const at u = 0.5: only ways that cross it are told of it, in whatever direction they go.
TEST(WayOnASurface, IsToldOfTheCreasesThatItMeetsAndOfNoOther) {
  const auto creasesFrom = [](std::vector<double> start, std::vector<double> target) {
    experiment::Experiment e = experiment::readExperiment("torus");
    e.constraint = {.name = {}, .curve = {}, .surface = {"u/10", "abs(u - 0.5)/10", "v/10"}, .shape = {}};
    e.task->start = std::move(start);
    e.task->target = std::move(target);
    int creases = 0;
    for (const Fault& fault : describeWay(experiment::CompiledExperiment(e)))
      creases += fault.what.find("abs(u - 0.5)") != std::string::npos ? 1 : 0;
    return creases;
  };
  for (const double v : {-1.0, 0.0, 0.4}) {
    EXPECT_EQ(creasesFrom({0.1, v}, {0.4, v}), 0) << v;
    EXPECT_EQ(creasesFrom({0.4, v}, {0.1, v + 1}), 0) << v;
    EXPECT_EQ(creasesFrom({0.6, v}, {0.9, v - 1}), 0) << v;
    EXPECT_EQ(creasesFrom({0.4, v}, {0.7, v}), 1) << v;
    EXPECT_EQ(creasesFrom({0.9, v}, {0.1, v + 1}), 1) << v;
  }
}

std::size_t tiesOf(const experiment::Experiment& e) {
  std::size_t ties = 0;
  for (const Fault& fault : describeWay(experiment::CompiledExperiment(e))) {
    EXPECT_EQ(fault.key, "task");
    ties +=
        fault.what.find("at right angles to the " + std::string(e.constraint.surface.empty() ? "curve" : "surface")) != std::string::npos;
  }
  return ties;
}

// On a circle the chord stands at right angles to it where it leads half-way round.
TEST(WayOnACurve, IsToldOfATieAtItsStart) {
  experiment::Experiment e = experiment::readExperiment("ellipse");
  e.constraint = {.name = {}, .curve = {"0.3*cos(phi)", "0.3*sin(phi)", "0"}, .surface = {}, .shape = {}};
  e.object.gravity = {};
  const auto tied = [&](double start, double target) {
    e.task->start = {start}, e.task->target = {target};
    return tiesOf(e) == 1;
  };
  constexpr double kPi = 3.14159265358979;
  EXPECT_TRUE(tied(0.4, 0.4 + kPi));
  EXPECT_FALSE(tied(0.4, 0.4 + kPi - 1e-4)) << "the pull is 5e-5 of the chord";
  EXPECT_TRUE(tied(0.4, 0.4 + kPi - 1e-6)) << "less than a millionth is rounding";
  EXPECT_FALSE(tied(0.4, 0.4 + 2 * kPi)) << "a lap has no chord";
  e.object.gravity = {0, 0, -9.81};
  EXPECT_TRUE(tied(0.4, 0.4 + kPi)) << "gravity across the curve decides nothing";
  e.object.gravity = {0, -9.81, 0};
  EXPECT_FALSE(tied(0.4, 0.4 + kPi)) << "gravity along it pulls one way";
}

TEST(WayOnASurface, IsToldOfATieAtItsStart) {
  experiment::Experiment e = experiment::readExperiment("torus");
  e.constraint = {.name = {}, .curve = {}, .surface = {"0.3*cos(u)*cos(v)", "0.3*sin(u)*cos(v)", "0.3*sin(v)"}, .shape = {}};  // a sphere
  e.object.gravity = {};
  e.task->start = {0.2, 0.3}, e.task->target = {0.2 + 3.14159265358979, -0.3};
  EXPECT_EQ(tiesOf(e), 1u) << "the other pole of it";
  e.task->target = {0.2 + 3.14159265358979, -0.2};
  EXPECT_EQ(tiesOf(e), 0u);
  e.task->target = {0.3 + 3.14159265358979, -0.3};
  EXPECT_EQ(tiesOf(e), 0u) << "along either of u and v";
}

TEST(WayOnACurve, IsToldOfTheCornersBetweenItsEnds) {
  experiment::Experiment e = experiment::readExperiment("ellipse");
  e.constraint = {.name = {}, .curve = {"phi/10", "abs(phi - 0.5)/10", "0"}, .surface = {}, .shape = {}};
  const auto corners = [&](double start, double target) {
    e.task->start = {start}, e.task->target = {target};
    return describeWay(experiment::CompiledExperiment(e)).size();
  };
  EXPECT_EQ(corners(0.1, 0.4), 0u);
  EXPECT_EQ(corners(0.6, 0.9), 0u);
  EXPECT_EQ(corners(0.1, 0.9), 1u);
  EXPECT_EQ(corners(0.9, 0.1), 1u);
  e.task.reset();
  EXPECT_TRUE(describeWay(experiment::CompiledExperiment(e)).empty());
  EXPECT_TRUE(describeWay(experiment::CompiledExperiment(experiment::readExperiment("free-point"))).empty());
}

}  // namespace
}  // namespace reachlab::trial
