#include "constraints/formula/program.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "base/fault.h"

namespace reachlab::constraints {
namespace {

class Compiler {
 public:
  Compiler(ExpressionGraph& graph, std::span<const int> roots, int parameterCount, int variableCount)
      : graph_(graph), parameterCount_(parameterCount), shape_(static_cast<int>(roots.size())),
        next_(shape_ + parameterCount + variableCount) {
    roots_ = graph.expandPowers(roots);
    needed_ = graph.reachableFrom(roots_);
    uses_ = graph.countUses(roots_);
    for (const int root : roots_) uses_[root] += 2;  // an output keeps its own register
    register_.assign(needed_.size(), -1);
    place_.assign(needed_.size(), -1);
    for (int k = static_cast<int>(roots_.size()); k-- > 0;) place_[roots_[k]] = k;
  }

  Program compile() {
    fuse();
    for (std::size_t id = 0; id < needed_.size(); ++id)
      if (needed_[id] && !fused_[id]) emitNode(static_cast<int>(id));
    for (std::size_t k = 0; k < roots_.size(); ++k) {
      if (graph_.isConstant(roots_[k])) program_.constants[k] = node(roots_[k]).value;
      else if (const std::uint16_t from = registerOf(roots_[k]); from != k)
        program_.copies.push_back({static_cast<std::uint16_t>(k), from});
    }
    emit(Code::Return, 0, 0, 0, 0, 0);
    pair();
    program_.parameterCount = static_cast<std::uint16_t>(parameterCount_);
    return std::move(program_);
  }

 private:
  const ExpressionNode& node(int id) const { return graph_.node(id); }

  // A product used once, by a sum, a sign or a factor, is computed with it (two roundings, as written).
  void fuse() {
    fused_.assign(needed_.size(), false);
    for (std::size_t id = 0; id < needed_.size(); ++id) {
      if (!needed_[id]) continue;
      const ExpressionNode& n = node(static_cast<int>(id));
      if (n.op == Op::Neg) {
        // The sign goes into the number of c * x; c * (x * y) stays whole.
        if (usedOnce(n.a) && (isPlainProduct(n.a) || isScaling(n.a))) markFused(n.a);
      } else if (isScaling(static_cast<int>(id))) {
        if (usedOnce(n.b) && isPlainProduct(n.b)) markFused(n.b);
      } else if (n.op == Op::Add || n.op == Op::Sub) {
        if (graph_.isConstant(n.a) || graph_.isConstant(n.b)) continue;
        if (usedOnce(n.a) && isPlainProduct(n.a)) markFused(n.a);
        else if (usedOnce(n.b) && isPlainProduct(n.b)) markFused(n.b);
      }
    }
  }
  void markFused(int id) { fused_[id] = true; }
  bool usedOnce(int id) const { return uses_[id] == 1; }
  bool isScaling(int id) const { return node(id).op == Op::Mul && graph_.isConstant(node(id).a) && !graph_.isConstant(node(id).b); }
  bool isPlainProduct(int id) const {
    const ExpressionNode& n = node(id);
    return n.op == Op::Mul && !graph_.isConstant(n.a) && !graph_.isConstant(n.b);
  }
  bool isFused(int id) const { return fused_[id]; }

  std::uint16_t newRegister() {
    if (next_ >= kMaxRegisters)
      throw FaultError(Fault{{},
                             fmt::format("the formula with its derivatives needs more than {} operations", kMaxRegisters - kMaxOutputs),
                             "a shorter formula"});
    return static_cast<std::uint16_t>(next_++);
  }
  void emit(Code code, int a, int b, int c, int out, double number) {
    const auto narrow = [](int x) { return static_cast<std::uint16_t>(x); };
    program_.instructions.push_back({handlerOf(code), number, narrow(a), narrow(b), narrow(c), narrow(out)});
    program_.codes.push_back(code);
  }
  void put(int id, Code code, int a, int b = 0, int c = 0, double number = 0) {
    const std::uint16_t out = registerFor(id);
    emit(code, a, b, c, out, number);
    register_[id] = out;
  }
  // A result's own place, else a new one.
  std::uint16_t registerFor(int id) {
    const int place = place_[id];
    return place >= 0 ? static_cast<std::uint16_t>(place) : newRegister();
  }

  // Two instructions of one kind in a row need one jump.
  void pair() {
    std::vector<Instruction>& all = program_.instructions;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
      const Code code = program_.codes[i];
      const void* const two = handlerOfTwo(code);
      if (two != nullptr && program_.codes[i + 1] == code) all[i++].handler = two;
    }
  }

  // Numbers are loaded only where an operation has no form with the number inside.
  std::uint16_t registerOf(int id) {
    int& r = register_[id];
    const ExpressionNode n = node(id);
    if (r < 0 && n.op == Op::Parameter) r = shape_ + n.a;
    if (r < 0 && n.op == Op::Variable) r = shape_ + parameterCount_ + n.a;
    if (r < 0) put(id, Code::Load, 0, 0, 0, n.value);
    return static_cast<std::uint16_t>(r);
  }

  void emitSinCos(int id) {
    const int argument = node(id).a;
    const auto found = sinCos_.find(argument);
    std::pair<std::uint16_t, std::uint16_t> both;
    if (found != sinCos_.end()) {
      both = found->second;
    } else {
      const std::uint16_t a = registerOf(argument);
      both.first = newRegister();
      both.second = newRegister();
      emit(Code::SinCos, a, both.first, both.second, 0, 0);
      sinCos_[argument] = both;
    }
    register_[id] = node(id).op == Op::Sin ? both.first : both.second;
  }

  // id = sign * (number * x), where x may be a product of its own.
  void emitScaling(int id, int scaling, double sign) {
    const ExpressionNode n = node(scaling);
    const double number = sign * node(n.a).value;
    if (!isFused(n.b)) return put(id, Code::MulC, registerOf(n.b), 0, 0, number);
    put(id, Code::MulMulC, registerOf(node(n.b).a), registerOf(node(n.b).b), 0, number);
  }

  void emitSum(int id, const ExpressionNode& n) {
    const bool minus = n.op == Op::Sub;
    if (isFused(n.a)) {
      const ExpressionNode& p = node(n.a);
      return put(id, minus ? Code::MulSub : Code::MulAdd, registerOf(p.a), registerOf(p.b), registerOf(n.b));
    }
    if (isFused(n.b)) {
      const ExpressionNode& p = node(n.b);
      return put(id, minus ? Code::RMulSub : Code::MulAdd, registerOf(p.a), registerOf(p.b), registerOf(n.a));
    }
    if (graph_.isConstant(n.b)) return put(id, Code::AddC, registerOf(n.a), 0, 0, minus ? -node(n.b).value : node(n.b).value);
    if (graph_.isConstant(n.a)) return put(id, minus ? Code::RSubC : Code::AddC, registerOf(n.b), 0, 0, node(n.a).value);
    put(id, minus ? Code::Sub : Code::Add, registerOf(n.a), registerOf(n.b));
  }

  void emitNode(int id) {
    const ExpressionNode n = node(id);
    switch (n.op) {
      case Op::Constant:
      case Op::Variable:
      case Op::Parameter: return;
      case Op::Add:
      case Op::Sub: return emitSum(id, n);
      case Op::Mul:
        if (graph_.isConstant(n.a)) return emitScaling(id, id, 1);
        if (graph_.isConstant(n.b)) return put(id, Code::MulC, registerOf(n.a), 0, 0, node(n.b).value);
        if (n.a == n.b) return put(id, Code::Square, registerOf(n.a));
        return put(id, Code::Mul, registerOf(n.a), registerOf(n.b));
      case Op::Div:
        if (graph_.isConstant(n.a)) return put(id, Code::RDivC, registerOf(n.b), 0, 0, node(n.a).value);
        return put(id, Code::Div, registerOf(n.a), registerOf(n.b));
      case Op::Neg:
        if (isFused(n.a) && isScaling(n.a)) return emitScaling(id, n.a, -1);
        if (isFused(n.a)) return put(id, Code::NegMul, registerOf(node(n.a).a), registerOf(node(n.a).b));
        return put(id, Code::Neg, registerOf(n.a));
      case Op::Sin:
      case Op::Cos: return emitSinCos(id);
      default: break;
    }
#define CODE_OF(name) {Op::name, Code::name},
    static const std::map<Op, Code> kCodes{REACHLAB_PLAIN_OPERATIONS(CODE_OF)};
#undef CODE_OF
    const int b = operandCount(n.op) == 2 ? registerOf(n.b) : 0;
    put(id, kCodes.at(n.op), registerOf(n.a), b);
  }

  ExpressionGraph& graph_;
  int parameterCount_;
  int shape_;  // register of the first parameter
  int next_;
  std::vector<int> roots_;
  std::vector<bool> needed_;
  std::vector<bool> fused_;
  std::vector<int> uses_;
  std::vector<int> register_;
  std::vector<int> place_;  // of the results
  std::map<int, std::pair<std::uint16_t, std::uint16_t>> sinCos_;
  Program program_;
};

}  // namespace

Program compileProgram(ExpressionGraph& graph, std::span<const int> roots, int parameterCount, int variableCount) {
  return Compiler(graph, roots, parameterCount, variableCount).compile();
}

}  // namespace reachlab::constraints
