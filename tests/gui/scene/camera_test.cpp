#include "gui/scene/camera.h"

#include <gtest/gtest.h>

#include <random>

namespace reachlab::gui::scene {
namespace {

constexpr double kViewWidth = 900, kViewHeight = 600;
constexpr double kRounding = 1e-9;  // a dozen operations on numbers of order 1 to 1000

Camera lookAt(const Vec3& centre, const Vec3& direction, bool parallel = false) {
  return lookAtPoints(std::array{centre}, 0.2, direction, 1.5, parallel);
}

TEST(Camera, APixelsPointIsDrawnAtThatPixel) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Camera camera = lookAt({any(random), any(random), any(random)}, {any(random), any(random), 1.2}, i % 2 == 0);
    const double x = 450 + 400 * any(random), y = 300 + 250 * any(random);
    const Vec3 point = pointUnder(camera, camera.focus, x, y, kViewWidth, kViewHeight);
    EXPECT_EQ(metresPerPixel(camera, {1, 2, 3}, kViewHeight) == metresPerPixel(camera, camera.focus, kViewHeight), camera.parallel);
    const auto pixel = pixelOf(camera, point, kViewWidth, kViewHeight);
    EXPECT_NEAR(pixel[0], x, 1e3 * kRounding);
    EXPECT_NEAR(pixel[1], y, 1e3 * kRounding);
  }
}

TEST(Camera, TurningKeepsTheDistanceAndTheFocus) {
  Camera camera = lookAt({0.1, 0.2, 0.3}, {0.3, 0.2, 1});
  const double before = norm(camera.position - camera.focus);
  const Vec3 focus = camera.focus;
  for (int i = 0; i < 50; ++i) turn(camera, 37, -21, kViewHeight);
  EXPECT_NEAR(norm(camera.position - camera.focus), before, kRounding);
  EXPECT_EQ(camera.focus, focus);
}

TEST(Camera, PanningMovesThePlaneWithThePointer) {
  Camera camera = lookAt({}, {0, 0, 1});
  const auto before = pixelOf(camera, {}, kViewWidth, kViewHeight);
  pan(camera, 30, -12, kViewHeight);
  const auto after = pixelOf(camera, {}, kViewWidth, kViewHeight);
  EXPECT_NEAR(after[0] - before[0], 30, 1e-6);
  EXPECT_NEAR(after[1] - before[1], -12, 1e-6);
}

TEST(Camera, AViewOfPointsHoldsThemAllAndFillsThePicture) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vec3> points;
  for (int i = 0; i < 50; ++i) points.push_back({0.3 * any(random), 0.1 * any(random), 0.2 * any(random)});
  for (const bool parallel : {false, true}) {
    const Camera camera = lookAtPoints(points, 0, {0.4, 0.3, 1}, kViewWidth / kViewHeight, parallel);
    double nearest = kViewWidth;
    for (const Vec3& p : points) {
      const auto [x, y] = pixelOf(camera, p, kViewWidth, kViewHeight);
      const double room = std::min({x, kViewWidth - x, y, kViewHeight - y});
      EXPECT_GT(room, -1e-6);
      nearest = std::min(nearest, room);
    }
    EXPECT_LT(nearest, 1);  // one of them touches the edge
  }
}

TEST(Camera, LookingStraightDownStillHasARightAndAnUp) {
  const CameraAxes axes = axesOf(lookAt({}, {0, 1, 0}));
  EXPECT_NEAR(norm(axes.right), 1, kRounding);
  EXPECT_NEAR(norm(axes.up), 1, kRounding);
}

}  // namespace
}  // namespace reachlab::gui::scene
