#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "tests/constraints/made_constraints.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace reachlab::constraints {
namespace {

TEST(PlaceOn, IsTheParametersPointOrNowhere) {
  EXPECT_EQ(placeOn(named("free"), std::array{1.0, 2.0, 3.0}), (Vec3{1, 2, 3}));
  const Constraint circle = named("circle"), sphere = named("sphere");
  EXPECT_EQ(placeOn(circle, std::array{0.7}), evaluate(circle.curve, 0.7).r);
  EXPECT_EQ(placeOn(sphere, std::array{0.7, 0.2}), evaluate(sphere.surface, 0.7, 0.2).r);
  EXPECT_FALSE(isFinite(placeOn(circle, std::array{0.7, 0.2}))) << "two parameters for a curve";
  EXPECT_FALSE(isFinite(placeOn(sphere, {})));
  EXPECT_FALSE(isFinite(placeOn(named("free"), std::array{1.0})));
}

// On a circle about the origin the direction stands at right angles to the radius, and points the way that is asked for.
TEST(TaskPath, FollowsTheTangentTowardsTheTarget) {
  const Constraint circle = named("circle");
  const std::array low{0.5}, high{2.0};
  const TaskPath up(circle, low, high), down(circle, high, low);
  EXPECT_TRUE(up.bent());
  EXPECT_EQ(up.start(), down.target());
  for (const double q : {0.5, 1.0, 2.0}) {
    const Vec3 direction = up.directionAt(q);
    EXPECT_NEAR(norm(direction), 1, kRounding);
    const Vec3 ahead = evaluate(circle.curve, q + 1e-6).r - evaluate(circle.curve, q - 1e-6).r;
    EXPECT_NEAR(dot(direction, ahead) / norm(ahead), 1, 1e-9) << "the chord of a short arc";
    EXPECT_EQ(down.directionAt(q), -direction);
  }
  EXPECT_NEAR(down.velocityAlong(up.directionAt(1.0), 1.0), -1, kRounding);
}

TEST(TaskPath, IsTheChordOnALineAndNoneOnASurface) {
  const TaskPath line(named("line"), std::array{0.0}, std::array{2 * std::numbers::pi});
  EXPECT_TRUE(line.straight());
  EXPECT_NEAR(norm(line.directionAt(17) - (line.target() - line.start()) / norm(line.target() - line.start())), 0, kRounding);
  const TaskPath sphere(named("sphere"), std::array{0.1, 0.2}, std::array{0.4, 0.3});
  EXPECT_EQ(sphere.directionAt(0.1), Vec3{});
  EXPECT_EQ(sphere.velocityAlong({0, -3, 4}, 0.1), 5) << "without a direction it is the speed";
  const TaskPath still(named("free"), std::array{1.0, 1.0, 1.0}, std::array{1.0, 1.0, 1.0});
  EXPECT_EQ(still.directionAt(0), Vec3{}) << "start and target are one place";
  EXPECT_EQ(TaskPath().directionAt(0), Vec3{}) << "no task";
}

}  // namespace
}  // namespace reachlab::constraints
