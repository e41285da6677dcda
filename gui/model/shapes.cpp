#include "gui/model/shapes.h"

#include <cmath>
#include <numbers>

namespace reachlab::gui::model {
namespace {

constexpr std::uint32_t kAround = 28, kRings = 14;

struct Ring {
  double radius = 0, y = 0;
};

// The surface that rings about y make, seen from outside with the first ring on top. A ring without a radius is a point: no triangle has two
// corners there.
void addTurned(ModelPart& part, const std::vector<Ring>& rings) {
  auto upper = static_cast<std::uint32_t>(part.points.size());
  for (const auto& [radius, y] : rings)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      part.points.push_back({radius * std::sin(angle), y, radius * std::cos(angle)});
    }
  for (std::size_t k = 1; k < rings.size(); ++k, upper += kAround)
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = upper + i, b = upper + (i + 1) % kAround;
      if (rings[k].radius > 0) part.triangles.push_back({a, a + kAround, b + kAround});
      if (rings[k - 1].radius > 0) part.triangles.push_back({a, b + kAround, b});
    }
}

}  // namespace

void addBox(ModelPart& part, const Vec3& size) {
  // Each side has corners of its own, so that edges stay edges.
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(part.points.size());
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        double c[3];
        c[axis] = sign, c[(axis + 1) % 3] = sign * a, c[(axis + 2) % 3] = b;
        part.points.push_back({0.5 * size.x * c[0], 0.5 * size.y * c[1], 0.5 * size.z * c[2]});
      }
      part.triangles.push_back({first, first + 1, first + 2});
      part.triangles.push_back({first, first + 2, first + 3});
    }
}

void addSphere(ModelPart& part, double radius) {
  std::vector<Ring> rings{{0, radius}};
  for (std::uint32_t ring = 1; ring < kRings; ++ring) {
    const double polar = std::numbers::pi * ring / kRings;
    rings.push_back({radius * std::sin(polar), radius * std::cos(polar)});
  }
  rings.push_back({0, -radius});
  addTurned(part, rings);
}

void addFrustum(ModelPart& part, double bottom, double top, double height, bool bottomClosed, bool topClosed, bool side) {
  const double low = -0.5 * height, high = 0.5 * height;
  if (side) addTurned(part, {{top, high}, {bottom, low}});
  if (bottomClosed) addTurned(part, {{bottom, low}, {0, low}});
  if (topClosed) addTurned(part, {{0, high}, {top, high}});
}

}  // namespace reachlab::gui::model
