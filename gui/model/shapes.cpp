#include "gui/model/shapes.h"

#include <cmath>
#include <numbers>

namespace reachlab::gui::model {
namespace {

constexpr std::uint32_t kAround = 28, kRings = 14;

std::uint32_t add(ModelPart& part, const Vec3& p) {
  part.points.push_back(p);
  return static_cast<std::uint32_t>(part.points.size() - 1);
}

void addQuad(ModelPart& part, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  part.triangles.push_back({a, b, c});
  part.triangles.push_back({a, c, d});
}

Vec3 onCircle(std::uint32_t i, double radius, double y) {
  const double angle = 2 * std::numbers::pi * i / kAround;
  return {radius * std::sin(angle), y, radius * std::cos(angle)};
}

void addDisc(ModelPart& part, const Transform& frame, double radius, double y, bool up) {
  const std::uint32_t middle = add(part, frame({0, y, 0}));
  for (std::uint32_t i = 0; i < kAround; ++i) add(part, frame(onCircle(i, radius, y)));
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const std::uint32_t a = middle + 1 + i, b = middle + 1 + (i + 1) % kAround;
    if (up) part.triangles.push_back({middle, a, b});
    else part.triangles.push_back({middle, b, a});
  }
}

}  // namespace

void addBox(ModelPart& part, const Transform& frame, const Vec3& size) {
  // Each side has corners of its own, so that edges stay edges.
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const auto corner = [&](double a, double b) {
        double c[3];
        c[axis] = sign, c[(axis + 1) % 3] = sign * a, c[(axis + 2) % 3] = b;
        return add(part, frame({0.5 * size.x * c[0], 0.5 * size.y * c[1], 0.5 * size.z * c[2]}));
      };
      const std::uint32_t a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
      addQuad(part, a, b, c, d);
    }
}

void addSphere(ModelPart& part, const Transform& frame, double radius) {
  const auto first = static_cast<std::uint32_t>(part.points.size());
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    const double polar = std::numbers::pi * ring / kRings;
    for (std::uint32_t i = 0; i < kAround; ++i) add(part, frame(onCircle(i, radius * std::sin(polar), radius * std::cos(polar))));
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = first + ring * kAround + i, b = first + ring * kAround + (i + 1) % kAround;
      addQuad(part, a, a + kAround, b + kAround, b);
    }
}

void addFrustum(ModelPart& part, const Transform& frame, double bottom, double top, double height, bool bottomClosed, bool topClosed,
                bool side) {
  const double low = -0.5 * height, high = 0.5 * height;
  if (side) {
    const auto first = static_cast<std::uint32_t>(part.points.size());
    for (std::uint32_t i = 0; i < kAround; ++i) add(part, frame(onCircle(i, bottom, low))), add(part, frame(onCircle(i, top, high)));
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % kAround);
      addQuad(part, a, b, b + 1, a + 1);
    }
  }
  if (bottomClosed) addDisc(part, frame, bottom, low, false);
  if (topClosed && top > 0) addDisc(part, frame, top, high, true);
}

}  // namespace reachlab::gui::model
