#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/vec3.h"
#include "constraints/constraint_spec.h"

/// A constraint as points and lines to draw, from the functions that the simulation uses, and without a graphics library. Sampling follows
/// curvature and is bounded, so the computation time of any formula is bounded.
namespace reachlab::gui::scene {

struct MeshOptions {
  double chordError = 5e-4;      // of the drawn size: how far a straight piece may leave the curve
  double turn = 0.12;            // [rad] between neighbouring pieces
  std::size_t maxPoints = 3000;  // of a curve
  std::size_t maxLines = 120;    // of a surface, each way
  std::size_t parameterLines = 16;
};

/// The drawn range of each parameter: the domain if it is bounded, else [0, 2 pi] or [-1, 1]. A range without bounds is widened so that start and
/// target lie inside with a margin.
std::array<constraints::Domain, 2> drawnDomain(const constraints::Constraint& constraint, std::span<const double> start,
                                               std::span<const double> target);

/// Pieces of a curve. A new piece begins after a gap where the formula is not finite. [m]
struct CurveMesh {
  std::vector<std::vector<Vec3>> pieces;
  std::size_t pointCount() const;
};
CurveMesh sampleCurve(const constraints::Curve& curve, double from, double to, const MeshOptions& options = {});

/// A surface as a grid of quads over parameter lines that lie closer where it bends, and the lines that are drawn on it. [m]
struct SurfaceMesh {
  std::vector<Vec3> points, normals;
  std::vector<std::array<std::uint32_t, 4>> quads;  // counter-clockwise about the normal
  std::vector<std::vector<Vec3>> parameterLines;
};
SurfaceMesh sampleSurface(const constraints::Surface& surface, const std::array<constraints::Domain, 2>& domain,
                          const MeshOptions& options = {});

/// Smallest box around points. Empty (valid() is false) if no point is finite.
struct Box {
  Vec3 low{1, 1, 1}, high{-1, -1, -1};
  bool valid() const { return low.x <= high.x; }
  Vec3 centre() const { return 0.5 * (low + high); }
  double diagonal() const { return valid() ? norm(high - low) : 0; }
  void add(const Vec3& p);
};
Box boxOf(const CurveMesh& mesh);
Box boxOf(const SurfaceMesh& mesh);

}  // namespace reachlab::gui::scene
