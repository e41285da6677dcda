// The place under a pixel, against a search through very many points of the shape.
#include "gui/scene/place_under.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "gui/scene_plan/definition_reach.h"
#include "gui/scene_plan/scene_plan.h"

namespace reachlab::gui::scene {
namespace {

constexpr double kPictureWidth = 900, kPictureHeight = 620;
constexpr double kNear = 1.5;       // pixels
constexpr double kOneSheet = 0.05;  // of the shape's size: at its edge a surface falls off by as much within a pixel

// A definition as the chooser shows it, looked at from the usual side.
struct ShownShape {
  explicit ShownShape(const constraints::Definition& definition) : constraint(constraints::makeConstraint(definition)) {
    plan = planScene(reachOn(definition), constraint);
    drawn = drawnDomain(constraint, definition.start, definition.target);
    camera = lookAtPoints(plan.seen, 0.06 * plan.size, plan.viewFrom, kPictureWidth / kPictureHeight);
  }
  std::vector<double> at(double u, double v) const {
    std::vector<double> q{drawn[0].lo + u * (drawn[0].hi - drawn[0].lo)};
    if (constraint.kind == constraints::ConstraintKind::Surface) q.push_back(drawn[1].lo + v * (drawn[1].hi - drawn[1].lo));
    return q;
  }
  std::array<double, 2> pixelOf(const std::vector<double>& q) const {
    return scene::pixelOf(camera, placeOn(constraint, q), kPictureWidth, kPictureHeight);
  }
  struct Sample {
    float x, y, depth;
  };
  // Where very many points of the shape are drawn.
  std::vector<Sample> samples() const {
    const bool surface = constraint.kind == constraints::ConstraintKind::Surface;
    const int along = surface ? 450 : 50'000, across = surface ? 450 : 0;
    std::vector<Sample> all;
    for (int i = 0; i <= along; ++i)
      for (int j = 0; j <= across; ++j) {
        const std::vector<double> q = at(double(i) / along, across == 0 ? 0 : double(j) / across);
        if (!isFinite(placeOn(constraint, q))) continue;
        const auto [x, y] = pixelOf(q);
        all.push_back({float(x), float(y), float(depthOf(q))});
      }
    return all;
  }
  double depthOf(const std::vector<double>& q) const { return dot(placeOn(constraint, q) - camera.position, axesOf(camera).forward); }

  constraints::Constraint constraint;
  ScenePlan plan;
  std::array<constraints::Domain, 2> drawn;
  Camera camera;
};

TEST(PlaceUnder, IsDrawnAtThePixelAndInFrontOnEveryShippedShape) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0.01, 0.99);
  for (const constraints::Definition& definition : constraints::catalogue()) {
    const ShownShape shown(definition);
    const bool surface = shown.constraint.kind == constraints::ConstraintKind::Surface;
    const std::vector<ShownShape::Sample> samples = shown.samples();
    for (int trial = 0; trial < (surface ? 12 : 20); ++trial) {
      const std::vector<double> q = shown.at(part(random), part(random));
      if (!isFinite(placeOn(shown.constraint, q))) continue;
      const auto [x, y] = shown.pixelOf(q);
      if (!(x > 0 && x < kPictureWidth && y > 0 && y < kPictureHeight)) continue;
      const auto found = placeUnder({shown.camera, x, y, kPictureWidth, kPictureHeight}, shown.constraint, shown.drawn, definition.start);
      ASSERT_TRUE(found.has_value()) << definition.name;
      const auto [foundX, foundY] = shown.pixelOf(*found);
      EXPECT_LE(std::hypot(foundX - x, foundY - y), kNear) << definition.name << " at " << q[0] << (surface ? q[1] : 0);
      double front = shown.depthOf(q);
      for (const ShownShape::Sample& s : samples)
        if (std::hypot(s.x - x, s.y - y) < 0.75) front = std::min(front, double(s.depth));
      EXPECT_LE(shown.depthOf(*found), front + kOneSheet * shown.plan.size)
          << definition.name << " shows another sheet at " << x << ' ' << y;
    }
  }
}

// Beside the shape: nothing of it is drawn nearer to the pixel.
TEST(PlaceUnder, IsTheNearestThatIsDrawnWhereThePixelIsBeside) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0, 1);
  for (const char* name : {"ellipse", "trefoil", "cycloid", "line", "torus", "sphere", "moebius-strip", "helicoid", "monkey-saddle"}) {
    const ShownShape shown(*constraints::findInCatalogue(name));
    const std::vector<ShownShape::Sample> samples = shown.samples();
    for (int trial = 0; trial < 8; ++trial) {
      const double x = kPictureWidth * part(random), y = kPictureHeight * part(random);
      const auto found = placeUnder({shown.camera, x, y, kPictureWidth, kPictureHeight}, shown.constraint, shown.drawn, {});
      ASSERT_TRUE(found.has_value()) << name;
      double least = 1e9;
      for (const ShownShape::Sample& s : samples) least = std::min(least, std::hypot(s.x - x, s.y - y));
      const auto [foundX, foundY] = shown.pixelOf(*found);
      EXPECT_LE(std::hypot(foundX - x, foundY - y), least + 0.05) << name << " at " << x << ' ' << y;
    }
  }
}

TEST(PlaceUnder, GoesOnRoundAClosedCurveAndHasFewDigits) {
  const ShownShape shown(*constraints::findInCatalogue("ellipse"));
  std::vector<double> q{0.1};
  for (double phi = 0; phi > -9; phi -= 0.2) {  // one and a half turns
    const auto [x, y] = shown.pixelOf({phi});
    q = *placeUnder({shown.camera, x, y, kPictureWidth, kPictureHeight}, shown.constraint, shown.drawn, q);
    EXPECT_NEAR(q[0], phi, 0.01);
  }
  const auto [x, y] = shown.pixelOf({1.23456789});
  const double found =
      (*placeUnder({shown.camera, x, y, kPictureWidth, kPictureHeight}, shown.constraint, shown.drawn, std::vector{1.0}))[0];
  EXPECT_EQ(found, std::round(found * 1e4) / 1e4) << "a picture shows no more";
}

// The strip has each point twice, two half turns apart.
TEST(PlaceUnder, HasTheParametersNearestToThoseBefore) {
  const ShownShape shown(*constraints::findInCatalogue("moebius-strip"));
  for (const double turn : {0.0, 2 * M_PI}) {
    const auto [x, y] = shown.pixelOf({0.9, 0.1});
    const auto found =
        placeUnder({shown.camera, x, y, kPictureWidth, kPictureHeight}, shown.constraint, shown.drawn, std::vector{0.8 + turn, 0.0});
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR((*found)[0], 0.9 + turn, 0.02);
  }
}

TEST(PlaceUnder, WithoutAConstraintLiesInThePlaneThatFacesTheViewer) {
  constraints::Constraint free;
  const Camera camera = lookAtPoints(std::array{Vec3{}}, 0.2, {0.3, 0.2, 1}, kPictureWidth / kPictureHeight);
  const std::vector<double> about{0.05, -0.02, 0.1};
  const auto found = placeUnder({camera, 300, 200, kPictureWidth, kPictureHeight}, free, {}, about);
  ASSERT_TRUE(found.has_value());
  const Vec3 r{(*found)[0], (*found)[1], (*found)[2]}, before{about[0], about[1], about[2]};
  const auto [x, y] = scene::pixelOf(camera, r, kPictureWidth, kPictureHeight);
  EXPECT_LE(std::hypot(x - 300, y - 200), 0.1);
  EXPECT_LE(std::abs(dot(r - before, axesOf(camera).forward)), 1e-4);
}

}  // namespace
}  // namespace reachlab::gui::scene
