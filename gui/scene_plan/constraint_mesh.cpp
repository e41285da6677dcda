#include "gui/scene_plan/constraint_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/math/segment.h"
#include "constraints/constraint.h"

namespace reachlab::gui::scene {
namespace {

double angleBetween(const Vec3& a, const Vec3& b) {
  const double scale = norm(a) * norm(b);
  return scale > 0 ? std::acos(std::clamp(dot(a, b) / scale, -1.0, 1.0)) : 0;
}

std::vector<double> evenly(double from, double to, std::size_t parts) {
  std::vector<double> values;
  for (std::size_t i = 0; i <= parts; ++i) values.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(parts));
  return values;
}

// A parameter and what is found there.
struct Knot {
  double at = 0;
  std::vector<Vec3> points;  // one a probe
  bool settled = false;      // the interval that begins here needs no half
};

using Probe = std::function<std::vector<Vec3>(double)>;

bool bendsTooMuch(const Knot& a, const Knot& middle, const Knot& b, double error, double turn) {
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Vec3 &p = a.points[i], &m = middle.points[i], &q = b.points[i];
    const bool known = isFinite(p) && isFinite(q) && isFinite(m);
    if (!known) {
      if (isFinite(p) || isFinite(q) || isFinite(m)) return true;  // the edge of where it exists
      continue;
    }
    const double length = norm(m - p) + norm(q - m);
    if (distanceToSegment(m, p, q) > error || (length > 8 * error && angleBetween(m - p, q - m) > turn)) return true;
  }
  return false;
}

// Halves the interval that needs it, level by level, until none does or the bound is reached.
std::vector<Knot> refine(const Probe& probe, double from, double to, std::size_t first, std::size_t most, double error, double turn) {
  std::vector<Knot> knots;
  for (const double at : evenly(from, to, first)) knots.push_back({at, probe(at)});
  for (int level = 0; level < 7; ++level) {
    std::vector<Knot> next;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      Knot &knot = knots[i], middle;
      if (!knot.settled && next.size() + (knots.size() - i) + 1 < most) {
        middle.at = 0.5 * (knot.at + knots[i + 1].at);
        middle.points = probe(middle.at);
        knot.settled = !bendsTooMuch(knot, middle, knots[i + 1], error, turn);
      } else {
        knot.settled = true;
      }
      const bool split = !knot.settled;
      next.push_back(std::move(knot));
      if (split) next.push_back(std::move(middle));
    }
    next.push_back(std::move(knots.back()));
    const bool changed = next.size() > knots.size();
    knots = std::move(next);
    if (!changed) break;
  }
  return knots;
}

std::vector<std::vector<Vec3>> finitePieces(const std::vector<Vec3>& points) {
  std::vector<std::vector<Vec3>> pieces;
  std::vector<Vec3> piece;
  const auto close = [&] {
    if (piece.size() > 1) pieces.push_back(piece);
    piece.clear();
  };
  for (const Vec3& p : points) {
    if (isFinite(p)) piece.push_back(p);
    else close();
  }
  close();
  return pieces;
}

// Where r_u x r_v vanishes (a pole, an apex) the normal is taken from the quads around it.
void fillNormals(SurfaceMesh& mesh) {
  std::vector<Vec3> around(mesh.points.size());
  for (const auto& quad : mesh.quads) {
    const Vec3 n = cross(mesh.points[quad[2]] - mesh.points[quad[0]], mesh.points[quad[3]] - mesh.points[quad[1]]);
    for (const std::uint32_t corner : quad) around[corner] += n;
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    Vec3& n = mesh.normals[i];
    if (isFinite(n) && norm(n) > 0) continue;
    const double length = norm(around[i]);
    n = length > 0 && std::isfinite(length) ? around[i] / length : Vec3{0, 0, 1};
  }
}

}  // namespace

std::size_t CurveMesh::pointCount() const {
  std::size_t count = 0;
  for (const auto& piece : pieces) count += piece.size();
  return count;
}

std::array<constraints::Domain, 2> drawnDomain(const constraints::Constraint& constraint, std::span<const double> start,
                                               std::span<const double> target) {
  std::array<constraints::Domain, 2> drawn = constraint.domain;
  const bool curve = constraint.kind == constraints::ConstraintKind::Curve;
  for (std::size_t i = 0; i < (curve ? 1u : 2u); ++i) {
    constraints::Domain& d = drawn[i];
    const bool openLow = !std::isfinite(d.lo), openHigh = !std::isfinite(d.hi);
    if (!openLow && !openHigh) continue;
    const double usual = curve ? 2 * std::numbers::pi : 2;
    double low = curve ? 0 : -1, high = curve ? 2 * std::numbers::pi : 1;
    const bool known = i < start.size() && i < target.size() && start[i] != target[i];
    const bool typed = constraint.name == "curve";
    if (curve && openLow && openHigh && known && !typed) low = high = 0.5 * (start[i] + target[i]);  // the task says where to look
    if (!openLow) low = d.lo, high = d.lo + usual;
    if (!openHigh) high = d.hi, low = std::min(low, d.hi - usual);
    if (i < start.size() && i < target.size()) {
      const double margin = (constraint.straight ? 0.12 : 0.25) * std::max(std::abs(target[i] - start[i]), 0.25 * (high - low));
      if (openLow) low = std::min({low, start[i] - margin, target[i] - margin});
      if (openHigh) high = std::max({high, start[i] + margin, target[i] + margin});
    }
    d.lo = low;
    d.hi = high;
  }
  // A surface without ends is no ribbon along the reach: hills beside it are seen too.
  const auto endless = [&](std::size_t i) { return !std::isfinite(constraint.domain[i].lo) && !std::isfinite(constraint.domain[i].hi); };
  if (constraint.kind == constraints::ConstraintKind::Surface && endless(0) && endless(1)) {
    const double least = 0.75 * std::max(drawn[0].hi - drawn[0].lo, drawn[1].hi - drawn[1].lo);
    for (constraints::Domain& d : drawn)
      if (const double missing = least - (d.hi - d.lo); missing > 0) d.lo -= 0.5 * missing, d.hi += 0.5 * missing;
  }
  return drawn;
}

CurveMesh sampleCurve(const constraints::Curve& curve, double from, double to, const MeshOptions& options) {
  const Probe probe = [&](double phi) { return std::vector<Vec3>{constraints::evaluate(curve, phi).r}; };
  Box rough;
  for (const double phi : evenly(from, to, 96)) rough.add(constraints::evaluate(curve, phi).r);
  std::vector<Vec3> points;
  for (const Knot& knot : refine(probe, from, to, 96, options.maxPoints, options.chordError * rough.diagonal(), options.turn))
    points.push_back(knot.points[0]);
  return {finitePieces(points)};
}

SurfaceMesh sampleSurface(const constraints::Surface& surface, const std::array<constraints::Domain, 2>& domain,
                          const MeshOptions& options) {
  const std::vector<double> probesU = evenly(domain[0].lo, domain[0].hi, 10), probesV = evenly(domain[1].lo, domain[1].hi, 10);
  Box rough;
  for (const double u : probesU)
    for (const double v : probesV) rough.add(constraints::evaluate(surface, u, v).r);
  // A quad shows its bend less than a line does.
  const double error = 3 * options.chordError * rough.diagonal(), turn = 1.5 * options.turn;
  const auto along = [&](std::size_t which) {
    const Probe probe = [&](double at) {
      std::vector<Vec3> points;
      for (const double other : which == 0 ? probesV : probesU)
        points.push_back(which == 0 ? constraints::evaluate(surface, at, other).r : constraints::evaluate(surface, other, at).r);
      return points;
    };
    std::vector<double> values;
    for (const Knot& knot : refine(probe, domain[which].lo, domain[which].hi, 20, options.maxLines, error, turn)) values.push_back(knot.at);
    return values;
  };
  const std::vector<double> us = along(0), vs = along(1);

  SurfaceMesh mesh;
  for (const double u : us)
    for (const double v : vs) {
      const constraints::SurfacePoint p = constraints::evaluate(surface, u, v);
      const Vec3 n = cross(p.rU, p.rV);
      const double length = norm(n), flat = 1e-7 * norm(p.rU) * norm(p.rV);
      mesh.points.push_back(p.r);
      mesh.normals.push_back(length > flat ? n / length : Vec3{});
    }
  const auto index = [&](std::size_t i, std::size_t j) { return static_cast<std::uint32_t>(i * vs.size() + j); };
  for (std::size_t i = 0; i + 1 < us.size(); ++i)
    for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
      const std::array<std::uint32_t, 4> quad{index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)};
      if (std::all_of(quad.begin(), quad.end(), [&](std::uint32_t k) { return isFinite(mesh.points[k]); })) mesh.quads.push_back(quad);
    }
  fillNormals(mesh);
  for (Vec3& p : mesh.points)
    if (!isFinite(p)) p = {};  // in no quad

  const auto drawLines = [&](std::size_t which, const std::vector<double>& fine) {
    for (const double fixed : evenly(domain[which].lo, domain[which].hi, options.parameterLines)) {
      std::vector<Vec3> line;
      for (const double at : fine)
        line.push_back(which == 0 ? constraints::evaluate(surface, fixed, at).r : constraints::evaluate(surface, at, fixed).r);
      for (auto& piece : finitePieces(line)) mesh.parameterLines.push_back(std::move(piece));
    }
  };
  drawLines(0, vs);
  drawLines(1, us);
  return mesh;
}

void Box::add(const Vec3& p) {
  if (!isFinite(p)) return;
  if (!valid()) {
    low = high = p;
    return;
  }
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

Box boxOf(const CurveMesh& mesh) {
  Box box;
  for (const auto& piece : mesh.pieces)
    for (const Vec3& p : piece) box.add(p);
  return box;
}

Box boxOf(const SurfaceMesh& mesh) {
  Box box;
  for (const auto& quad : mesh.quads)
    for (const std::uint32_t corner : quad) box.add(mesh.points[corner]);
  return box;
}

}  // namespace reachlab::gui::scene
