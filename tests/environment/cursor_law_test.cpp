#include "sim/environment/cursor_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace reachlab::environment {
namespace {

using namespace experiment;

const Vec3 kStart{0.1, 0.02, 0.3}, kTarget{0.1, 0.02, 0.2};  // forward on the table
const Vec3 kHand = kStart + Vec3{0.01, 0.003, -0.04};

Cursor cursorOf(double rotation, double gain = 1, std::optional<double> clamp = {}) {
  return {.rotation = rotation, .gain = gain, .clamp = clamp};
}
CursorLaw lawOf(const Cursor& cursor) { return {cursor, TaskPlane::Horizontal, kStart, kTarget}; }
/// Angle of the way from the start, counterclockwise from the right as seen from above [degrees].
double angleOf(const Vec3& place) { return std::atan2(-(place.z - kStart.z), place.x - kStart.x) * 180 / std::numbers::pi; }

TEST(CursorLaw, WithoutRotationAndGainTheCursorIsAtTheHand) { EXPECT_NEAR(norm(lawOf({})(kHand) - kHand), 0, 1e-16); }

TEST(CursorLaw, ARotationTurnsTheWayByItsAngleAboutTheStart) {
  for (const double degrees : {-90.0, 30.0, 45.0}) {
    const Vec3 cursor = lawOf(cursorOf(degrees))(kHand);
    EXPECT_NEAR(angleOf(cursor) - angleOf(kHand), degrees, 1e-12) << degrees;
    EXPECT_NEAR(norm(cursor - kStart), norm(kHand - kStart), 1e-16);
    EXPECT_NEAR(cursor.y, kHand.y, 1e-16) << "height is not rotated";
  }
}

TEST(CursorLaw, AGainScalesTheWay) { EXPECT_NEAR(norm(lawOf(cursorOf(0, 1.5))(kHand) - (kStart + 1.5 * (kHand - kStart))), 0, 1e-16); }

TEST(CursorLaw, AClampedCursorKeepsItsDirectionWhereverTheHandGoes) {
  const CursorLaw clamped = lawOf(cursorOf(0, 1, 30));
  for (const Vec3& hand : {kHand, kStart + Vec3{0.05, 0, 0.01}, kTarget}) {
    EXPECT_NEAR(angleOf(clamped(hand)), 90 + 30, 1e-9);
    EXPECT_NEAR(norm(clamped(hand) - kStart), norm(hand - kStart), 1e-16);
  }
  EXPECT_EQ(clamped(kStart), kStart);
}

TEST(CursorLaw, TellsWhichPointIsJudged) {
  EXPECT_TRUE(lawOf({}).isJudged());
  EXPECT_FALSE(lawOf({.clamp = {}, .judge = CursorJudge::Hand}).isJudged());
}

}  // namespace
}  // namespace reachlab::environment
