#include "constraints/formula/expression.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <iterator>

#include "base/fault.h"
#include "base/math/elementary.h"
#include "constraints/formula/operations.h"

namespace reachlab::constraints {
namespace {

constexpr int kMaxIntegerExponent = 64;  // larger ones go through pow

constexpr const char* kOpNames[] = {"constant", "variable", "parameter", "+",   "-",    "*",    "/",    "-",     "^",
                                    "^",        "sin",      "cos",       "tan", "asin", "acos", "atan", "atan2", "sinh",
                                    "cosh",     "tanh",     "exp",       "log", "sqrt", "abs",  "sign"};
static_assert(std::size(kOpNames) == static_cast<std::size_t>(Op::Sign) + 1);

double powInteger(double x, int n) noexcept {
  double result = 1;
  for (double square = x; n > 0; n /= 2, square *= square)
    if (n % 2 == 1) result *= square;
  return result;
}

bool commutes(Op op) { return op == Op::Add || op == Op::Mul; }

}  // namespace

const char* nameOf(Op op) { return kOpNames[static_cast<int>(op)]; }

int operandCount(Op op) {
  switch (op) {
    case Op::Constant:
    case Op::Variable:
    case Op::Parameter: return 0;
    case Op::Add:
    case Op::Sub:
    case Op::Mul:
    case Op::Div:
    case Op::Pow:
    case Op::Atan2: return 2;
    default: return 1;
  }
}

double applyOp(Op op, double a, double b) noexcept {
#define CASE(name) \
  case Op::name: return resultOf<Code::name>(a, b, 0, 0);
  switch (op) {
    REACHLAB_PLAIN_OPERATIONS(CASE)
    case Op::PowInt: return powInteger(a, static_cast<int>(b));
    case Op::Sin: return sine(a);
    case Op::Cos: return cosine(a);
    case Op::Constant:
    case Op::Variable:
    case Op::Parameter: break;
  }
#undef CASE
  return 0;
}

std::size_t ExpressionGraph::KeyHash::operator()(const Key& key) const noexcept {
  std::uint64_t h = static_cast<std::uint64_t>(key.op) + 0x9e3779b97f4a7c15u;
  for (const std::uint64_t part : {static_cast<std::uint64_t>(static_cast<std::uint32_t>(key.a)),
                                   static_cast<std::uint64_t>(static_cast<std::uint32_t>(key.b)), key.bits}) {
    h ^= part + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
    h *= 0xff51afd7ed558ccdu;
  }
  return static_cast<std::size_t>(h ^ (h >> 31));
}

int ExpressionGraph::intern(const ExpressionNode& node) {
  Key key{node.op, node.a, node.b, std::bit_cast<std::uint64_t>(node.value)};
  if (commutes(node.op) && key.a > key.b) std::swap(key.a, key.b);
  if (const auto found = ids_.find(key); found != ids_.end()) return found->second;
  if (size() >= kMaxExpressionNodes)
    throw FaultError(Fault{{}, "the formula with its derivatives is too large", fmt::format("{} operations", kMaxExpressionNodes)});
  nodes_.push_back(node);
  return ids_[key] = size() - 1;
}

int ExpressionGraph::constant(double value) { return intern({Op::Constant, -1, -1, value == 0 ? 0.0 : value}); }
int ExpressionGraph::variable(int index) { return intern({Op::Variable, index, -1, 0}); }
int ExpressionGraph::parameter(int index) { return intern({Op::Parameter, index, -1, 0}); }

// A node as factor * rest, where the factor is a number: constants and signs stand outermost.
ExpressionGraph::Scaled ExpressionGraph::splitFactor(int id) const {
  const ExpressionNode& n = node(id);
  if (n.op == Op::Neg) {
    const Scaled inner = splitFactor(n.a);
    return {-inner.factor, inner.id};
  }
  if (n.op == Op::Mul && isConstant(n.a)) return {node(n.a).value, n.b};
  return {1, id};
}

int ExpressionGraph::scale(double factor, int id) {
  if (isConstant(id)) return constant(factor * node(id).value);
  if (factor == 0) return constant(0);
  if (factor < 0) return neg(scale(-factor, id));
  if (factor == 1) return id;
  return intern({Op::Mul, constant(factor), id, 0});
}

int ExpressionGraph::neg(int a) {
  const ExpressionNode n = node(a);
  if (n.op == Op::Constant) return constant(-n.value);
  if (n.op == Op::Neg) return n.a;
  return intern({Op::Neg, a, -1, 0});
}

// sin^2 + cos^2 = 1, also with a common factor: k sin(t)^2 + k cos(t)^2 = k.
bool ExpressionGraph::joinSquares(int a, int b, int& joined) {
  const auto squareOf = [&](int id, Op op) {
    const ExpressionNode& n = node(id);
    return n.op == Op::PowInt && n.b == 2 && node(n.a).op == op ? node(n.a).a : -1;
  };
  const auto complementary = [&](int p, int q) {
    const int s = squareOf(p, Op::Sin), c = squareOf(q, Op::Cos);
    return s >= 0 && s == c;
  };
  if (complementary(a, b) || complementary(b, a)) {
    joined = constant(1);
    return true;
  }
  // (k sin t)^2 + (k cos t)^2 = k^2
  const auto isSquare = [&](int id) { return node(id).op == Op::PowInt && node(id).b == 2; };
  const bool squares = isSquare(a) && isSquare(b);
  const ExpressionNode x = node(squares ? node(a).a : a), y = node(squares ? node(b).a : b);
  if (x.op != Op::Mul || y.op != Op::Mul) return false;
  const auto complementaryWaves = [&](int p, int q) {
    const ExpressionNode &s = node(p), &c = node(q);
    return s.a == c.a && ((s.op == Op::Sin && c.op == Op::Cos) || (s.op == Op::Cos && c.op == Op::Sin));
  };
  for (const auto& [k1, p] : {std::pair{x.a, x.b}, std::pair{x.b, x.a}})
    for (const auto& [k2, q] : {std::pair{y.a, y.b}, std::pair{y.b, y.a}})
      if (k1 == k2 && (squares ? complementaryWaves(p, q) : complementary(p, q) || complementary(q, p))) {
        joined = squares ? powInt(k1, 2) : k1;
        return true;
      }
  return false;
}

int ExpressionGraph::sum(int a, int b, bool minus) {
  if (isConstant(a) && isConstant(b)) return constant(minus ? node(a).value - node(b).value : node(a).value + node(b).value);
  if (isConstant(b, 0)) return a;
  if (isConstant(a, 0)) return minus ? neg(b) : b;
  if (node(b).op == Op::Neg) return sum(a, node(b).a, !minus);
  if (node(a).op == Op::Neg) return minus ? neg(sum(node(a).a, b, false)) : sum(b, node(a).a, true);
  if (a == b) return minus ? constant(0) : scale(2, a);
  const Scaled x = splitFactor(a), y = splitFactor(b);
  if (x.id == y.id) return scale(minus ? x.factor - y.factor : x.factor + y.factor, x.id);
  if (x.factor == y.factor && x.factor != 1 && !isConstant(a) && !isConstant(b)) return scale(x.factor, sum(x.id, y.id, minus));
  int joined = -1;
  if (!minus && joinSquares(a, b, joined)) return joined;
  return intern({minus ? Op::Sub : Op::Add, a, b, 0});
}

int ExpressionGraph::add(int a, int b) { return sum(a, b, false); }
int ExpressionGraph::sub(int a, int b) { return sum(a, b, true); }

int ExpressionGraph::mul(int a, int b) {
  if (isConstant(a)) std::swap(a, b);
  if (isConstant(b)) {
    const Scaled x = splitFactor(a);
    return isConstant(a) ? constant(node(a).value * node(b).value) : scale(x.factor * node(b).value, x.id);
  }
  const Scaled x = splitFactor(a), y = splitFactor(b);
  if (x.factor != 1 || y.factor != 1) return scale(x.factor * y.factor, mul(x.id, y.id));
  // Powers of one base join.
  const auto base = [&](int id) { return node(id).op == Op::PowInt ? std::pair{node(id).a, node(id).b} : std::pair{id, 1}; };
  const auto [baseA, exponentA] = base(a);
  const auto [baseB, exponentB] = base(b);
  if (baseA == baseB && exponentA + exponentB <= kMaxIntegerExponent) return powInt(baseA, exponentA + exponentB);
  // x * (1 / y) = x / y
  if (node(b).op == Op::Div && isConstant(node(b).a, 1)) return div(a, node(b).b);
  if (node(a).op == Op::Div && isConstant(node(a).a, 1)) return div(b, node(a).b);
  return intern({Op::Mul, a, b, 0});
}

int ExpressionGraph::div(int a, int b) {
  if (isConstant(b) && node(b).value != 0 && std::isfinite(1 / node(b).value))
    return isConstant(a) ? constant(node(a).value / node(b).value) : mul(a, constant(1 / node(b).value));
  if (isConstant(a, 0) && !isConstant(b)) return a;
  if (a == b && !isConstant(b)) return constant(1);
  const Scaled x = splitFactor(a), y = splitFactor(b);
  if (!isConstant(b) && y.factor < 0) return neg(div(a, neg(b)));
  if (!isConstant(a) && x.factor != 1) return scale(x.factor, div(x.id, b));
  if (isConstant(a) && node(a).value < 0) return neg(div(constant(-node(a).value), b));
  return intern({Op::Div, a, b, 0});
}

bool ExpressionGraph::isNeverNegative(int id) const {
  const ExpressionNode& n = node(id);
  switch (n.op) {
    case Op::Constant: return n.value >= 0;
    case Op::PowInt: return n.b % 2 == 0 || isNeverNegative(n.a);
    case Op::Add:
    case Op::Mul:
    case Op::Div: return isNeverNegative(n.a) && isNeverNegative(n.b);
    case Op::Abs:
    case Op::Sqrt:
    case Op::Exp:
    case Op::Cosh: return true;
    default: return false;
  }
}

int ExpressionGraph::powInt(int a, int exponent) {
  if (exponent == 0) return constant(1);
  if (exponent == 1) return a;
  if (exponent < 0) return div(constant(1), powInt(a, -exponent));
  const ExpressionNode n = node(a);
  if (n.op == Op::Constant) return constant(powInteger(n.value, exponent));
  if (n.op == Op::Neg) return exponent % 2 == 0 ? powInt(n.a, exponent) : neg(powInt(n.a, exponent));
  if (n.op == Op::Mul && isConstant(n.a)) return scale(powInteger(node(n.a).value, exponent), powInt(n.b, exponent));
  if (n.op == Op::PowInt && n.b * exponent <= kMaxIntegerExponent) return powInt(n.a, n.b * exponent);
  if (n.op == Op::Sqrt && exponent % 2 == 0 && isNeverNegative(n.a)) return powInt(n.a, exponent / 2);  // else it would lose its end
  return intern({Op::PowInt, a, exponent, 0});
}

int ExpressionGraph::pow(int a, int b) {
  if (isConstant(b)) {
    const double exponent = node(b).value;
    if (std::abs(exponent) <= kMaxIntegerExponent && exponent == std::floor(exponent)) return powInt(a, static_cast<int>(exponent));
    if (exponent == 0.5) return apply(Op::Sqrt, a);
    if (isConstant(a)) return constant(elementary::pow(node(a).value, exponent));
  }
  return intern({Op::Pow, a, b, 0});
}

int ExpressionGraph::apply(Op function, int a, int b) {
  if (isConstant(a) && (operandCount(function) == 1 || isConstant(b)))
    return constant(applyOp(function, node(a).value, b < 0 ? 0 : node(b).value));
  // sqrt(a^2) is |a|: squared, a loses the digits that decide near its zero.
  if (function == Op::Sqrt && node(a).op == Op::PowInt && node(a).b % 2 == 0) {
    const ExpressionNode square = node(a);
    return square.b % 4 == 0 ? powInt(square.a, square.b / 2) : apply(Op::Abs, powInt(square.a, square.b / 2));
  }
  if (node(a).op == Op::Neg) {
    const int inner = node(a).a;
    switch (function) {
      case Op::Cos:
      case Op::Cosh:
      case Op::Abs: return apply(function, inner);
      case Op::Sin:
      case Op::Tan:
      case Op::Asin:
      case Op::Atan:
      case Op::Sinh:
      case Op::Tanh:
      case Op::Sign: return neg(apply(function, inner));
      default: break;
    }
  }
  return intern({function, a, b, 0});
}

std::vector<bool> ExpressionGraph::reachableFrom(std::span<const int> roots) const {
  std::vector<bool> needed(nodes_.size(), false);
  for (const int root : roots) needed[root] = true;
  for (int id = size() - 1; id >= 0; --id) {
    if (!needed[id]) continue;
    const ExpressionNode& n = node(id);
    const int operands = operandCount(n.op);
    if (operands >= 1) needed[n.a] = true;
    if (operands == 2) needed[n.b] = true;
  }
  return needed;
}

std::vector<int> ExpressionGraph::countUses(std::span<const int> roots) const {
  const std::vector<bool> needed = reachableFrom(roots);
  std::vector<int> uses(needed.size(), 0);
  for (std::size_t id = 0; id < needed.size(); ++id) {
    if (!needed[id]) continue;
    const ExpressionNode& n = nodes_[id];
    const int operands = operandCount(n.op);
    if (operands >= 1) ++uses[n.a];
    if (operands == 2) ++uses[n.b];
  }
  return uses;
}

OperationList ExpressionGraph::operationsFor(std::span<const int> roots, const double* shape) const {
  OperationList list;
  list.roots = madeOfNodes<int>(*this, roots, [&](int, ExpressionNode n, const std::vector<int>& place) {
    const int operands = operandCount(n.op);
    if (n.op == Op::Parameter) n = {Op::Constant, -1, -1, shape[n.a]};
    if (operands >= 1) n.a = place[n.a];
    if (operands == 2) n.b = place[n.b];
    list.operations.push_back(n);
    return static_cast<int>(list.operations.size()) - 1;
  });
  return list;
}

std::vector<int> ExpressionGraph::expandPowers(std::span<const int> roots) {
  return madeOfNodes<int>(*this, roots, [&](int id, const ExpressionNode& n, const std::vector<int>& image) {
    if (operandCount(n.op) == 0) return id;
    if (n.op != Op::PowInt) return intern({n.op, image[n.a], operandCount(n.op) == 2 ? image[n.b] : n.b, n.value});
    int result = -1;
    int square = image[n.a];
    for (int rest = n.b; rest > 0; rest /= 2) {
      if (rest % 2 == 1) result = result < 0 ? square : intern({Op::Mul, square, result, 0});
      if (rest > 1) square = intern({Op::Mul, square, square, 0});
    }
    return result;
  });
}

}  // namespace reachlab::constraints
