#include "constraints/regularity/rounding.h"

#include <algorithm>
#include <cmath>

#include "constraints/constraint.h"
#include "constraints/formula/formula.h"

namespace reachlab::constraints {
namespace {

constexpr double kUnit = 0x1p-53;               // of a result, by one operation
constexpr double kUnitOfFunctions = 2 * kUnit;  // of sincos.h and elementary.h

struct Value {
  double value = 0, off = 0;
};

/// What an error of the operands becomes, without the operation's own rounding.
double handedOn(Op op, const Value& a, const Value& b, int exponent, double value) {
  const double x = std::abs(a.value);
  // Where a root or an arc ends an error counts by its root.
  const auto atMostRoot = [&](double slope) { return std::min(slope * a.off, std::sqrt(2 * a.off)); };
  switch (op) {
    case Op::Add:
    case Op::Sub: return a.off + b.off;
    case Op::Neg:
    case Op::Abs: return a.off;
    case Op::Mul: return x * b.off + std::abs(b.value) * a.off;
    case Op::Div: return (a.off + std::abs(value) * b.off) / std::abs(b.value);
    case Op::PowInt: return std::abs(exponent * std::pow(a.value, exponent - 1)) * a.off;
    case Op::Pow:
      return (a.off > 0 ? std::abs(b.value * std::pow(a.value, b.value - 1)) * a.off : 0) +
             (b.off > 0 && x > 0 ? std::abs(value * std::log(x)) * b.off : 0);
    case Op::Sin: return std::abs(std::cos(a.value)) * a.off;
    case Op::Cos: return std::abs(std::sin(a.value)) * a.off;
    case Op::Tan: return (1 + value * value) * a.off;
    case Op::Asin:
    case Op::Acos: return atMostRoot(1 / std::sqrt(std::max(0.0, 1 - x * x)));
    case Op::Atan: return a.off / (1 + x * x);
    case Op::Atan2: return (std::abs(b.value) * a.off + x * b.off) / (x * x + b.value * b.value);
    case Op::Sinh: return std::cosh(x) * a.off;
    case Op::Cosh: return std::sinh(x) * a.off;
    case Op::Tanh: return (1 - value * value) * a.off;
    case Op::Exp: return value * a.off;
    case Op::Log: return a.off / x;
    case Op::Sqrt: return atMostRoot(0.5 / value);
    case Op::Constant:
    case Op::Variable:
    case Op::Parameter:
    case Op::Sign: break;
  }
  return 0;
}

}  // namespace

double computeRounding(const Constraint& constraint, double first, double second) {
  if (constraint.formula == nullptr) return 0;
  const OperationList list = constraint.formula->graph.operationsFor(constraint.formula->place(), constraint.shape());
  std::vector<Value> values;
  for (const ExpressionNode& n : list.operations) {
    Value& out = values.emplace_back();
    if (n.op == Op::Constant) out.value = n.value;
    if (n.op == Op::Variable) out.value = n.a == 0 ? first : second;
    if (operandCount(n.op) == 0) continue;
    const Value a = values[n.a];
    const Value b = operandCount(n.op) == 2 ? values[n.b] : Value{};
    out.value = applyOp(n.op, a.value, n.op == Op::PowInt ? n.b : b.value);
    const double off = a.off > 0 || b.off > 0 ? handedOn(n.op, a, b, n.b, out.value) : 0;
    const bool exact = n.op == Op::Neg || n.op == Op::Abs || n.op == Op::Sign;
    out.off = off + (exact ? 0 : (n.op >= Op::Pow && n.op <= Op::Log ? kUnitOfFunctions : kUnit) * std::abs(out.value));
  }
  double most = 0;
  for (const int root : list.roots) most = std::max(most, values[root].off);
  return most;
}

}  // namespace reachlab::constraints
