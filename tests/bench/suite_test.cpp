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

TEST(Suite, TheCheapestRowIsTheFirstOfTheLeastPriceThatErrsNoMoreThanAllowed) {
  const auto row = [](const char* scene, const char* method, double error, double price) {
    Row made;
    made.scene = scene, made.method = method, made.error.state = error, made.nsPerMs = price;
    return made;
  };
  const std::vector<Row> rows{row("S1", "rk4", 1e-6, 10), row("S1", "exact", 1e-12, 30), row("S1", "abm", 1e-9, 20), row("S2", "rk4", 0, 1),
                              row("S1", "stiff", 1e-9, 20)};
  const auto cheapestOf = [&](double error) {
    const Row* found = cheapest(rows, "S1", error, [](const Row&) { return true; });
    return found ? found->method : "none";
  };
  EXPECT_EQ(cheapestOf(1e-6), "rk4") << "just what is allowed";
  EXPECT_EQ(cheapestOf(0.9e-6), "abm");
  EXPECT_EQ(cheapestOf(1e-9), "abm");
  EXPECT_EQ(cheapestOf(1e-10), "exact");
  EXPECT_EQ(cheapestOf(1e-13), "none");
  EXPECT_EQ(cheapest(rows, "S1", 1, [](const Row& r) { return r.method == "exact"; })->method, "exact");
}

}  // namespace
}  // namespace reachlab::bench
