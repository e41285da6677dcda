#include "constraints/regularity/narrow_band.h"

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/roots.h"
#include "constraints/regularity/narrow.h"

namespace reachlab::constraints {
namespace {

constexpr double kAway = 8;
constexpr double kPart = 0.05;  // of a tick's way: wider ones are seen by the method, and refusing is hard
constexpr int kSamples = 9;     // across

}  // namespace

std::optional<NarrowBand> findNarrowBand(const Constraint& surface, const std::array<double, 2>& start) {
  if (surface.surface.function != evaluateSurfaceProgram) return {};
  std::vector<double> bends;
  std::array<std::vector<double>, 2> speeds;
  for (int i = 0; i < kSamples * kSamples; ++i) {
    const double u = start[0] + 0.23 * (i % kSamples - kSamples / 2), v = start[1] + 0.23 * (i / kSamples - kSamples / 2);
    const SurfacePoint p = evaluate(surface.surface, u, v);
    const double bend = norm(p.rUu) + norm(p.rUv) + norm(p.rVv) + norm(p.rU) + norm(p.rV);
    if (!std::isfinite(bend)) continue;
    bends.push_back(bend);
    speeds[0].push_back(norm(p.rU));
    speeds[1].push_back(norm(p.rV));
  }
  if (bends.empty()) return {};
  const double most = narrow::kMuch * narrow::median(bends);
  const auto& formula = *std::static_pointer_cast<const CompiledFormula>(surface.owner);
  const double* shape = surface.surface.shape.data();
  try {
    for (int k = 0; k < 2; ++k) {
      ExpressionGraph graph = formula.graph;
      const std::vector<int> r{formula.roots[0], formula.roots[1], formula.roots[2]};
      int excess = graph.constant(-most * most);
      for (const int bend : graph.differentiate(graph.differentiate(r, k), k)) excess = graph.add(excess, graph.powInt(bend, 2));
      const double centre = start[static_cast<std::size_t>(k)], other = start[static_cast<std::size_t>(1 - k)];
      const Domain& d = surface.domain[static_cast<std::size_t>(k)];
      const double lo = d.periodic ? centre - kAway : std::max(d.lo, centre - kAway),
                   hi = d.periodic ? centre + kAway : std::min(d.hi, centre + kAway);
      int boxes = narrow::kBoxes;
      const RootSearch search = findRoots(graph, excess, shape, lo, hi, boxes, 1e-12, k, other);
      const double speed = narrow::median(speeds[static_cast<std::size_t>(k)]);
      for (std::size_t i = 0; i + 1 < search.roots.size(); ++i) {
        const double a = search.roots[i], b = search.roots[i + 1];
        std::array<double, 2> q{other, other};
        q[static_cast<std::size_t>(k)] = a + (b - a) / 2;
        const std::vector<int> one{excess};
        const double over = evaluateNodes(graph, one, shape, q.data())[0];
        if (over > 0 && std::isfinite(over) && (b - a) * speed < kPart * narrow::kWay) return NarrowBand{k, a + (b - a) / 2, b - a};
      }
    }
  } catch (const FaultError&) {  // third derivatives too large to be formed: nothing is known
  }
  return {};
}

}  // namespace reachlab::constraints
