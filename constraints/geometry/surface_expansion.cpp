#include "constraints/geometry/surface_expansion.h"

#include "base/error.h"
#include "constraints/constraint.h"
#include "constraints/geometry/taylor.h"

namespace reachlab::constraints {

static_assert(kMaxExpansion == Taylor::kMaxDegree);

SurfaceFormula::SurfaceFormula(const Constraint& surface) {
  if (surface.kind != ConstraintKind::Surface) throw RefusedError(surface.name + " is no surface");
  list_ = surface.formula->graph.operationsFor(surface.formula->place(), surface.shape());
}

SurfaceExpansion SurfaceFormula::expand(double u, double v, int order) const {
  std::vector<Taylor> value(list_.operations.size());
  for (size_t i = 0; i < list_.operations.size(); ++i) {
    const ExpressionNode& o = list_.operations[i];
    if (o.op == Op::Constant) {
      value[i].c[0] = o.value;
    } else if (o.op == Op::Variable) {
      value[i].c[0] = o.a == 0 ? u : v;
      if (order > 0) value[i].c[Taylor::place(o.a == 0, o.a != 0)] = 1;
    } else {
      const Taylor& x = value[o.a];
      const bool two = operandCount(o.op) == 2;
      value[i] = apply(o.op, x, two ? value[o.b] : x, two ? 0 : o.b, order);
    }
  }
  SurfaceExpansion d{};
  const auto &x = value[list_.roots[0]].c, &y = value[list_.roots[1]].c, &z = value[list_.roots[2]].c;
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
