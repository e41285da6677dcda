#pragma once
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace reachlab::constraints {

enum class Op : std::uint8_t {
  Constant,
  Variable,
  Parameter,
  Add,
  Sub,
  Mul,
  Div,
  Neg,
  PowInt,
  Pow,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Atan2,
  Sinh,
  Cosh,
  Tanh,
  Exp,
  Log,
  Sqrt,
  Abs,
  Sign
};
const char* nameOf(Op op);
/// Number of operands that are nodes. PowInt has a single operand, because its exponent is a number.
int operandCount(Op op);

/// One operation on earlier nodes. A Constant uses `value`. For Variable and Parameter, `a` is the index. For PowInt, `b` is the exponent.
struct ExpressionNode {
  Op op = Op::Constant;
  int a = -1, b = -1;
  double value = 0;
};

/// Value of one operation on numbers, exactly as the compiled forms compute it.
double applyOp(Op op, double a, double b) noexcept;

/// Nodes without gaps, each after its operands: `a` and `b` are places in the list. A Parameter is a Constant here.
struct OperationList {
  std::vector<ExpressionNode> operations;
  std::vector<int> roots;
};

/// Expressions that share their equal parts: equal nodes are stored once. Operands precede the nodes that use them, so a walk in index
/// order needs no recursion. Building simplifies: constants fold, signs and constant factors move outwards, powers of the same base join.
/// Throws FaultError above kMaxExpressionNodes nodes.
class ExpressionGraph {
 public:
  static constexpr int kMaxExpressionNodes = 20000;

  int constant(double value);
  int variable(int index);
  int parameter(int index);
  int add(int a, int b);
  int sub(int a, int b);
  int mul(int a, int b);
  int div(int a, int b);
  int neg(int a);
  int pow(int a, int b);
  int powInt(int a, int exponent);
  int apply(Op function, int a, int b = -1);

  /// d(root)/d(variable) of each root, exact.
  std::vector<int> differentiate(std::span<const int> roots, int variable);
  /// The roots with every integer power written out as products (the form that is compiled).
  std::vector<int> expandPowers(std::span<const int> roots);

  const ExpressionNode& node(int id) const { return nodes_[id]; }
  int size() const { return static_cast<int>(nodes_.size()); }
  bool isConstant(int id) const { return node(id).op == Op::Constant; }
  bool isConstant(int id, double value) const { return isConstant(id) && node(id).value == value; }
  /// Below 0 nowhere, as its form alone shows: squares, their sums and products, abs, exp …
  bool isNeverNegative(int id) const;
  /// Which nodes the roots need.
  std::vector<bool> reachableFrom(std::span<const int> roots) const;
  /// How often each node is an operand of a node that the roots need.
  std::vector<int> countUses(std::span<const int> roots) const;
  /// The nodes that the roots need as a list, with the values of the shape in place of the parameters.
  OperationList operationsFor(std::span<const int> roots, const double* shape) const;

 private:
  struct Key {
    Op op;
    int a, b;
    std::uint64_t bits;
    bool operator==(const Key&) const = default;
  };
  struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept;
  };
  struct Scaled {  // factor * id
    double factor;
    int id;
  };
  int intern(const ExpressionNode& node);
  Scaled splitFactor(int id) const;
  int scale(double factor, int id);
  int sum(int a, int b, bool minus);
  bool joinSquares(int a, int b, int& joined);
  int derivativeOf(int id, const std::vector<int>& d);

  std::vector<ExpressionNode> nodes_;
  std::unordered_map<Key, int, KeyHash> ids_;
};

/// Walks over the nodes that the roots need, and returns the results of the roots. The function `of` makes a result from the number of a
/// node, the node, and the results of earlier nodes. The function may add nodes to the graph.
template <class Made, class Of>
std::vector<Made> madeOfNodes(const ExpressionGraph& graph, std::span<const int> roots, Of&& of) {
  const std::vector<bool> needed = graph.reachableFrom(roots);
  std::vector<Made> made(needed.size()), result;
  for (std::size_t id = 0; id < needed.size(); ++id)
    if (needed[id]) made[id] = of(static_cast<int>(id), ExpressionNode(graph.node(static_cast<int>(id))), made);
  for (const int root : roots) result.push_back(made[root]);
  return result;
}

}  // namespace reachlab::constraints
