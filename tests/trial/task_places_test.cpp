#include "sim/trial/task_places.h"

#include <gtest/gtest.h>

#include "sim/experiment/resources.h"

namespace reachlab::trial {
namespace {

// A crease along v = const at u = 0.5: only ways that cross it are told of it, in whatever direction they go.
TEST(WayOnASurface, IsToldOfTheCreasesThatItMeetsAndOfNoOther) {
  const auto creasesFrom = [](std::vector<double> start, std::vector<double> target) {
    experiment::Experiment e = experiment::readExperiment("torus");
    e.constraint = {};
    e.constraint.name.clear();
    e.constraint.surface = {"u/10", "abs(u - 0.5)/10", "v/10"};
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

}  // namespace
}  // namespace reachlab::trial
