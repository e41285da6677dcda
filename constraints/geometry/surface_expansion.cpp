#include "constraints/geometry/surface_expansion.h"

#include "base/error.h"
#include "constraints/constraint.h"
#include "constraints/geometry/taylor.h"

namespace reachlab::constraints {

static_assert(kMaxExpansion == Taylor::kMaxDegree);

SurfaceFormula::SurfaceFormula(const Constraint& surface) {
  if (surface.kind != ConstraintKind::Surface) throw RefusedError(surface.name + " is no surface");
  const auto& formula = *std::static_pointer_cast<const CompiledFormula>(surface.owner);
  const ExpressionGraph& graph = formula.graph;
  const std::vector<int> roots(formula.roots.begin(), formula.roots.begin() + 3);
  const std::vector<bool> needed = graph.reachableFrom(roots);
  std::vector<int> place(needed.size(), -1);
  for (size_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    const ExpressionNode& node = graph.node(static_cast<int>(id));
    place[id] = static_cast<int>(operations_.size());
    Operation made{node.op, node.a, node.b, node.value};
    if (node.op == Op::Parameter) made = {Op::Constant, -1, -1, surface.surface.shape[static_cast<size_t>(node.a)]};
    else if (node.op != Op::Constant && node.op != Op::Variable) {
      made.a = place[static_cast<size_t>(node.a)];
      if (operandCount(node.op) == 2) made.b = place[static_cast<size_t>(node.b)];
    }
    operations_.push_back(made);
  }
  for (size_t k = 0; k < 3; ++k) roots_[k] = place[static_cast<size_t>(roots[k])];
}

SurfaceExpansion SurfaceFormula::expand(double u, double v, int order) const {
  std::vector<Taylor> value(operations_.size());
  for (size_t i = 0; i < operations_.size(); ++i) {
    const Operation& o = operations_[i];
    if (o.op == Op::Constant) {
      value[i].c[0] = o.value;
    } else if (o.op == Op::Variable) {
      value[i].c[0] = o.a == 0 ? u : v;
      if (order > 0) value[i].c[Taylor::place(o.a == 0, o.a != 0)] = 1;
    } else {
      const Taylor& x = value[static_cast<size_t>(o.a)];
      const bool two = operandCount(o.op) == 2;
      value[i] = apply(o.op, x, two ? value[static_cast<size_t>(o.b)] : x, two ? 0 : o.b, order);
    }
  }
  SurfaceExpansion d{};
  const auto &x = value[static_cast<size_t>(roots_[0])].c, &y = value[static_cast<size_t>(roots_[1])].c,
             &z = value[static_cast<size_t>(roots_[2])].c;
  double aFactorial = 1;
  for (int a = 0; a <= order; aFactorial *= ++a) {
    double factor = aFactorial;
    for (int b = 0; a + b <= order; factor *= ++b) {
      const auto at = static_cast<size_t>(Taylor::place(a, b));
      d[a][b] = factor * Vec3{x[at], y[at], z[at]};
    }
  }
  return d;
}

}  // namespace reachlab::constraints
