#include "base/ticks.h"
#include "bench/suite.h"
#include "sim/haptics/measure_ticks.h"

#include <gtest/gtest.h>

#include <map>

namespace reachlab::bench {
namespace {

struct Bound {
  double state, position;
};
constexpr double kNoBound = 1e300;

// What is promised of `auto` at 1 ms: linear scenes to rounding, smooth ones to a state error of 1e-10, hard geometry to a position of
// 1e-10 m with at most a thousand right-hand sides in a tick.
TEST(Suite, AutoKeepsItsPromiseOnEveryScene) {
  const std::map<std::string, Bound> promised{
      {"S1", {1e-13, 1e-13}},  {"S1b50", {1e-12, 1e-13}}, {"S2a", {1e-10, 1e-10}},   {"S2b", {1e-10, 1e-10}},
      {"S3", {1e-10, 1e-10}},  {"S4", {1e-10, 1e-10}},    {"S5", {kNoBound, 1e-10}}, {"S5h", {kNoBound, 1e-10}},
      {"S6", {1e-13, 1e-13}},  {"S7a", {1e-12, 1e-13}},   {"S7b", {1e-13, 1e-13}},   {"S7c", {kNoBound, 1e-10}},
      {"S7d", {1e-13, 1e-13}}, {"S7e", {1e-13, 1e-13}},   {"S7f", {1e-10, 1e-10}},   {"S8", {1e-10, 1e-10}}};
  for (const auto& [name, bound] : promised) {
    SCOPED_TRACE(name);
    const BenchScene scene = benchScene(name);
    const Contender contender = makePlantContender(scene, "auto", kTickSeconds, 0);
    Trajectory trajectory;
    contender.run(&trajectory);
    ASSERT_EQ(trajectory.failure, "");
    const Deviation error = computeError(trajectory, computeReference(scene));
    EXPECT_LE(error.state, bound.state);
    EXPECT_LE(error.position, bound.position);
    EXPECT_LE(trajectory.worstTick, 1000u);
  }
}

// A trial that ended and began anew would be a price of beginnings.
TEST(Suite, ATickIsTimedWithinOneTrialOnEveryScene) {
  for (const BenchScene& scene : benchScenes()) EXPECT_EQ(haptics::measureTicks(scene.experiment, 2000).trials, 1u) << scene.name;
}

}  // namespace
}  // namespace reachlab::bench
