#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/guards.h"
#include "constraints/formula/interval.h"
#include "constraints/formula/roots.h"
#include "constraints/regularity/analysis.h"
#include "constraints/regularity/surface_branches.h"

namespace reachlab::constraints {
namespace {

constexpr int kMaxBoxes = 20000;
constexpr double kSmallestBox = 1.0 / (1 << 20);

/// Interval arithmetic on boxes shows `holds(bounds)` of the roots everywhere in the domain.
template <class Holds>
bool isProved(const ExpressionGraph& graph, const std::vector<int>& roots, const double* shape, const std::array<Domain, 2>& domain,
              const Holds& holds) {
  IntervalEvaluator bounds(graph, roots, shape);
  std::array<Interval, 2> whole;
  bool finite = true;
  for (std::size_t k = 0; k < 2; ++k) {
    const double inf = std::numeric_limits<double>::infinity();
    whole[k] = domain[k].periodic ? Interval{-inf, inf} : Interval{domain[k].lo, domain[k].hi};
    finite = finite && std::isfinite(whole[k].lo) && std::isfinite(whole[k].hi);
  }
  std::vector<std::array<Interval, 2>> stack{whole};
  for (int boxes = 0; !stack.empty(); ++boxes) {
    const std::array<Interval, 2> box = stack.back();
    stack.pop_back();
    bounds.evaluate(box);
    if (holds(bounds)) continue;
    if (!finite || boxes > kMaxBoxes) return false;
    std::array<double, 2> width{};
    for (std::size_t k = 0; k < 2; ++k) width[k] = (box[k].hi - box[k].lo) / std::max(whole[k].hi - whole[k].lo, 1e-300);
    const std::size_t k = width[1] > width[0] ? 1 : 0;
    if (width[k] < kSmallestBox) return false;
    const double middle = box[k].lo + (box[k].hi - box[k].lo) / 2;
    auto left = box, right = box;
    left[k].hi = right[k].lo = middle;
    stack.push_back(right);
    stack.push_back(left);
  }
  return true;
}

/// The argument meets its level nowhere in the domain; atan2's cut lies where x < 0.
bool isProvedAway(const ExpressionGraph& graph, const Guard& guard, const double* shape, const std::array<Domain, 2>& domain) {
  std::vector<int> roots{guard.argument};
  if (guard.op == Op::Atan2) roots.push_back(graph.node(guard.node).b);
  return isProved(graph, roots, shape, domain, [&](const IntervalEvaluator& bounds) {
    const Interval range = bounds.rangeOf(0);
    return range.lo > guard.level || range.hi < guard.level || (roots.size() > 1 && bounds.rangeOf(1).lo > 0);
  });
}

PlaceKind kindOf(const Guard& guard) {
  switch (guard.op) {
    case Op::Log:
    case Op::Div:
    case Op::Tan: return PlaceKind::Pole;
    case Op::Abs: return PlaceKind::Kink;
    case Op::Sign:
    case Op::Atan2: return PlaceKind::Jump;
    default: return PlaceKind::End;
  }
}

/// The surface and its derivatives up to the second, with every passable guard on the side that its bit of `index` says.
std::vector<int> branchRoots(ExpressionGraph& graph, std::span<const int> r, const std::vector<Guard>& active,
                             const std::vector<SurfaceBranches::Line>& lines, int index) {
  std::vector<Guard> guards;
  std::vector<int> signs;
  for (std::size_t k = 0; k < active.size(); ++k) {
    if (!lines[k].passable) continue;
    guards.push_back(active[k]);
    signs.push_back((index >> lines[k].bit & 1) != 0 ? 1 : -1);
  }
  return withDerivatives(graph, freezeBranches(graph, r, guards, signs), ConstraintKind::Surface);
}

/// For people: lines of one parameter by their values, others by their equation. `roots`: of each guard, g and its two derivatives.
void addPlaces(const Constraint& c, ExpressionGraph& graph, const std::vector<Guard>& active, const std::vector<int>& roots,
               SurfaceBranches& result) {
  const CompiledFormula& formula = *c.formula;
  const std::array<Domain, 2> range = boundedDomain(c);
  for (std::size_t k = 0; k < active.size(); ++k) {
    const int g = roots[3 * k];
    const bool byU = !graph.isConstant(roots[3 * k + 1], 0), byV = !graph.isConstant(roots[3 * k + 2], 0);
    Place place;
    place.kind = result.lines[k].kind;
    place.because = result.lines[k].because;
    if (byU && byV) {
      place.parameter = -1;
      place.because = writeFormula(graph, g, variablesOf(ConstraintKind::Surface), formula.text.parameters);
      result.places.push_back(place);
      continue;
    }
    place.parameter = byU ? 0 : 1;
    const Domain& d = range[byU ? 0 : 1];
    int boxes = kMaxBoxes;
    for (const double root : findRoots(graph, g, c.shape(), d.lo, d.hi, boxes, active[k].branches() ? 1e-12 : 1e-7, byU ? 0 : 1).roots) {
      place.at = root + 0.0;
      result.places.push_back(place);
    }
  }
}

struct Owned {
  Program guards;
  std::vector<Program> branches;
};

}  // namespace

std::array<SurfaceBranches::Guarded, SurfaceBranches::kMaxGuards> SurfaceBranches::at(double u, double v) const noexcept {
  SurfacePoint room;
  evaluateSurfaceProgram(program, shape.data(), u, v, room);
  std::array<Guarded, kMaxGuards> result;
  const Vec3* values = &room.r;
  for (int k = 0; k < kMaxGuards; ++k) result[k] = {values[k].x, values[k].y, values[k].z};
  return result;
}

bool isProvedRegular(const Constraint& c, const std::array<Domain, 2>& range) {
  if (c.kind != ConstraintKind::Surface || c.formula == nullptr) return false;
  const CompiledFormula& formula = *c.formula;
  ExpressionGraph graph = formula.graph;
  const double* shape = c.shape();
  const std::span<const int> r = formula.place();
  for (const Guard& guard : findGuards(graph, r, shape))
    if (!isProvedAway(graph, guard, shape, range)) return false;
  const std::vector<int> u = graph.differentiate(r, 0), v = graph.differentiate(r, 1);
  std::vector<int> area;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    area.push_back(graph.sub(graph.mul(u[a], v[b]), graph.mul(u[b], v[a])));
  }
  return isProved(graph, area, shape, range, [](const IntervalEvaluator& bounds) {
    bool apart = false;
    for (std::size_t k = 0; k < 3; ++k) apart = apart || bounds.rangeOf(k).lo > 0 || bounds.rangeOf(k).hi < 0;
    return apart;
  });
}

std::shared_ptr<const SurfaceBranches> computeBranches(const Constraint& c) {
  auto result = std::make_shared<SurfaceBranches>();
  if (c.kind != ConstraintKind::Surface || c.formula == nullptr) return result;
  const CompiledFormula& formula = *c.formula;
  ExpressionGraph graph = formula.graph;
  const std::span<const int> r = formula.place();
  const double* shape = c.shape();
  const std::vector<Guard> all = findGuards(graph, r, shape);
  std::vector<Guard> active;
  for (const Guard& guard : all)
    if (!isProvedAway(graph, guard, shape, c.domain)) active.push_back(guard);
  if (active.empty()) return result;
  if (active.size() > SurfaceBranches::kMaxGuards)
    throw FaultError(
        Fault{{},
              fmt::format("the surface's formula has {} operations that are not smooth everywhere (abs, sign, roots, quotients …)",
                          active.size()),
              fmt::format("{}", SurfaceBranches::kMaxGuards)});
  const std::vector<std::string> variables = variablesOf(ConstraintKind::Surface);
  int bits = 0;
  for (const Guard& guard : active) {
    SurfaceBranches::Line line;
    line.because = writeFormula(graph, guard.node, variables, formula.text.parameters);
    line.kind = kindOf(guard);
    line.level = guard.level;
    line.passable = guard.branches() && bits < SurfaceBranches::kMaxBranching;
    if (line.passable) line.bit = bits++;
    result->lines.push_back(line);
  }
  auto owned = std::make_shared<Owned>();
  owned->branches.reserve(std::size_t{1} << bits);
  const int parameters = static_cast<int>(formula.text.parameters.size());
  for (int index = 0; index < (1 << bits); ++index) {
    owned->branches.push_back(compileProgram(graph, branchRoots(graph, r, active, result->lines, index), parameters, 2));
    result->branches.push_back({evaluateSurfaceProgram, &owned->branches.back(), c.surface.shape});
  }
  std::vector<int> roots;
  for (const Guard& guard : active) {
    const int g = guard.level == 0 ? guard.argument : graph.sub(guard.argument, graph.constant(guard.level));
    roots.insert(roots.end(), {g, graph.differentiate(std::span(&g, 1), 0)[0], graph.differentiate(std::span(&g, 1), 1)[0]});
  }
  while (roots.size() < 3 * SurfaceBranches::kMaxGuards) roots.push_back(graph.constant(1));
  owned->guards = compileProgram(graph, roots, parameters, 2);
  result->program = &owned->guards;
  result->shape = c.surface.shape;
  result->owner = owned;

  addPlaces(c, graph, active, roots, *result);
  return result;
}

}  // namespace reachlab::constraints
