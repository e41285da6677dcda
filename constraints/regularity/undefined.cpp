#include "constraints/regularity/undefined.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "constraints/constraint.h"
#include "constraints/formula/formula.h"

namespace reachlab::constraints {
namespace {

constexpr int kLooks = 64;

// Irrational places, so that none of them is special to a formula.
double placeIn(const Domain& range, int i, double step) { return range.lo + (range.hi - range.lo) * std::fmod(0.5 + i * step, 1.0); }

// What an operation needs of its last operand, or of its exponent's base. Empty: any number.
std::string neededBy(Op op) {
  switch (op) {
    case Op::Sqrt: return "0 or more";
    case Op::Pow: return "0 or more, or a whole exponent";
    case Op::Log: return "more than 0";
    case Op::Asin:
    case Op::Acos: return "-1 to 1";
    case Op::Div: return "other than 0";
    default: return {};
  }
}

struct Values {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  int finite = 0;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value), high = std::max(high, value), ++finite;
  }
};

std::string textOf(const Values& values) {
  return values.low == values.high ? fmt::format("{:.4g}", values.low) : fmt::format("{:.4g} to {:.4g}", values.low, values.high);
}

}  // namespace

std::optional<Fault> undefinedFault(const Constraint& c, const std::array<Domain, 2>& range) {
  if (c.kind == ConstraintKind::Free) return std::nullopt;
  const bool curve = c.kind == ConstraintKind::Curve;
  std::vector<std::array<double, 2>> places;
  for (int i = 1; i <= kLooks; ++i) places.push_back({placeIn(range[0], i, 0.7548776662466927), placeIn(range[1], i, 0.5698402909980532)});
  for (const auto& [u, v] : places)
    if (isFinite(curve ? evaluate(c.curve, u).r : evaluate(c.surface, u, v).r)) return std::nullopt;
  std::string where =
      curve ? fmt::format("phi from {:.4g} to {:.4g}", range[0].lo, range[0].hi)
            : fmt::format("u from {:.4g} to {:.4g} and v from {:.4g} to {:.4g}", range[0].lo, range[0].hi, range[1].lo, range[1].hi);
  Fault fault{{}, "has no value at any " + where, "a formula with a value there"};
  if (c.formula == nullptr) return fault;

  // The first part that never has a value, while what it is made of has.
  const CompiledFormula& formula = *c.formula;
  for (std::size_t coordinate = 0; coordinate < 3; ++coordinate) {
    const int root = formula.roots[coordinate];
    std::vector<int> nodes(static_cast<std::size_t>(root) + 1);
    std::iota(nodes.begin(), nodes.end(), 0);
    std::vector<Values> seen(nodes.size());
    for (const auto& place : places) {
      const std::vector<double> values = evaluateNodes(formula.graph, nodes, c.shape(), place.data());
      for (std::size_t i = 0; i < values.size(); ++i) seen[i].add(values[i]);
    }
    if (seen.back().finite > 0) continue;
    const std::vector<bool> part = formula.graph.reachableFrom(std::span(&root, 1));
    fault.what = fmt::format("{} has no value at any {}", "xyz"[coordinate], where);
    for (int i = 0; i <= root; ++i) {
      const ExpressionNode& node = formula.graph.node(i);
      const int operand = node.op == Op::Div ? node.b : node.a;
      if (!part[i] || seen[i].finite > 0 || operandCount(node.op) == 0) continue;
      const std::string needed = neededBy(node.op);
      if (needed.empty() || seen[operand].finite == 0) break;
      const std::string name = node.op == Op::Div ? "a division" : node.op == Op::Pow ? "a power" : nameOf(node.op);
      fault.what += fmt::format(": {} is given {}", name, textOf(seen[operand]));
      fault.allowed = fmt::format("{} for {}; look for a wrong sign, or for a range that is shifted", needed, name);
      break;
    }
    break;
  }
  return fault;
}

}  // namespace reachlab::constraints
