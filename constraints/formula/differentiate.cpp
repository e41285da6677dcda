#include "constraints/formula/expression.h"

namespace reachlab::constraints {

// The rule of one operation, given the derivatives `d` of the nodes before it.
int ExpressionGraph::derivativeOf(int id, const std::vector<int>& d) {
  const ExpressionNode n = node(id);
  const int operands = operandCount(n.op);
  const int da = operands >= 1 ? d[n.a] : -1;
  const int db = operands == 2 ? d[n.b] : -1;
  // Nothing that does not move: keeps 0 * (1/0) and the like out of the result.
  if ((operands == 1 && isConstant(da, 0)) || (operands == 2 && isConstant(da, 0) && isConstant(db, 0))) return constant(0);
  const int one = constant(1);
  const auto square = [&](int a) { return powInt(a, 2); };
  switch (n.op) {
    case Op::Add: return add(da, db);
    case Op::Sub: return sub(da, db);
    case Op::Mul: return add(mul(da, n.b), mul(n.a, db));
    case Op::Div: return div(sub(da, mul(id, db)), n.b);
    case Op::Neg: return neg(da);
    case Op::PowInt: return mul(scale(n.b, powInt(n.a, n.b - 1)), da);
    case Op::Pow:
      if (isConstant(db, 0)) return mul(mul(n.b, pow(n.a, sub(n.b, one))), da);
      return mul(id, add(mul(db, apply(Op::Log, n.a)), isConstant(da, 0) ? constant(0) : mul(n.b, div(da, n.a))));
    case Op::Sin: return mul(apply(Op::Cos, n.a), da);
    case Op::Cos: return neg(mul(apply(Op::Sin, n.a), da));
    case Op::Tan: return mul(add(one, square(id)), da);
    case Op::Asin: return div(da, apply(Op::Sqrt, sub(one, square(n.a))));
    case Op::Acos: return neg(div(da, apply(Op::Sqrt, sub(one, square(n.a)))));
    case Op::Atan: return div(da, add(one, square(n.a)));
    case Op::Atan2: return div(sub(mul(n.b, da), mul(n.a, db)), add(square(n.a), square(n.b)));
    case Op::Sinh: return mul(apply(Op::Cosh, n.a), da);
    case Op::Cosh: return mul(apply(Op::Sinh, n.a), da);
    case Op::Tanh: return mul(sub(one, square(id)), da);
    case Op::Exp: return mul(id, da);
    case Op::Log: return div(da, n.a);
    case Op::Sqrt: return div(scale(0.5, da), id);
    case Op::Abs: return mul(apply(Op::Sign, n.a), da);
    case Op::Sign:
    case Op::Constant:
    case Op::Variable:
    case Op::Parameter: break;
  }
  return constant(0);
}

std::vector<int> ExpressionGraph::differentiate(std::span<const int> roots, int variable) {
  return madeOfNodes<int>(*this, roots, [&](int id, const ExpressionNode& n, const std::vector<int>& d) {
    return n.op == Op::Variable ? constant(n.a == variable ? 1 : 0) : derivativeOf(id, d);
  });
}

}  // namespace reachlab::constraints
