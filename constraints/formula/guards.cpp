#include "constraints/formula/guards.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "constraints/formula/formula.h"

namespace reachlab::constraints {
std::vector<bool> findMoving(const ExpressionGraph& graph) {
  std::vector<bool> moves(static_cast<std::size_t>(graph.size()), false);
  for (int id = 0; id < graph.size(); ++id) {
    const ExpressionNode& n = graph.node(id);
    const int operands = operandCount(n.op);
    moves[id] = n.op == Op::Variable || (operands >= 1 && moves[n.a]) || (operands == 2 && moves[n.b]);
  }
  return moves;
}

std::vector<Guard> findGuards(ExpressionGraph& graph, std::span<const int> roots, const double* shape) {
  const std::vector<bool> needed = graph.reachableFrom(roots), moves = findMoving(graph);
  std::vector<Guard> guards;
  for (std::size_t id = 0; id < needed.size(); ++id) {
    if (!needed[id] || !moves[id]) continue;
    const ExpressionNode n = graph.node(static_cast<int>(id));
    const auto moving = [&](int operand) { return operand >= 0 && moves[operand]; };
    const auto add = [&](int argument, double level = 0) {
      if (argument >= static_cast<int>(moves.size()) || moving(argument)) guards.push_back({n.op, static_cast<int>(id), argument, level});
    };
    switch (n.op) {
      case Op::Abs:
      case Op::Sign:
      case Op::Sqrt:
      case Op::Log: add(n.a); break;
      case Op::Div: add(n.b); break;
      case Op::Atan2:
        if (moving(n.a)) add(n.a);
        else if (evaluateNode(graph, n.a, shape, nullptr) == 0) add(n.b);
        break;
      case Op::Asin:
      case Op::Acos:
        add(n.a, 1);
        add(n.a, -1);
        break;
      case Op::Tan: add(graph.apply(Op::Cos, n.a)); break;
      case Op::Pow: {
        const double exponent = moving(n.b) ? 0.5 : evaluateNode(graph, n.b, shape, nullptr);
        if (!(exponent >= 0 && exponent == std::floor(exponent))) add(n.a);
        break;
      }
      default: break;
    }
  }
  return guards;
}

std::vector<int> freezeBranches(ExpressionGraph& graph, std::span<const int> roots, const std::vector<Guard>& guards,
                                const std::vector<int>& signs) {
  const std::vector<bool> moves = findMoving(graph);
  std::map<int, int> signAt;
  for (std::size_t k = 0; k < guards.size() && k < signs.size(); ++k)
    if (guards[k].branches()) signAt[guards[k].node] = signs[k];
  return madeOfNodes<int>(graph, roots, [&](int id, const ExpressionNode& n, const std::vector<int>& image) {
    const int operands = operandCount(n.op);
    const int a = operands >= 1 ? image[n.a] : -1, b = operands == 2 ? image[n.b] : -1;
    if (const auto sign = signAt.find(id); sign != signAt.end() && (n.op != Op::Atan2 || sign->second != 0)) {
      const int side = graph.constant(sign->second);
      if (n.op == Op::Sign) return side;
      if (n.op == Op::Atan2 && !moves[n.a]) return graph.apply(n.op, a, b);
      if (n.op == Op::Abs) return graph.mul(side, a);
      // By a quarter turn, so that the cut lies on the other side.
      return graph.add(graph.constant(sign->second * std::numbers::pi / 2),
                       graph.apply(Op::Atan2, graph.mul(graph.constant(-sign->second), b), graph.mul(side, a)));
    }
    switch (n.op) {
      case Op::Constant:
      case Op::Variable:
      case Op::Parameter: return id;
      case Op::Add: return graph.add(a, b);
      case Op::Sub: return graph.sub(a, b);
      case Op::Mul: return graph.mul(a, b);
      case Op::Div: return graph.div(a, b);
      case Op::Neg: return graph.neg(a);
      case Op::Pow: return graph.pow(a, b);
      case Op::PowInt: return graph.powInt(a, n.b);
      default: return graph.apply(n.op, a, b);
    }
  });
}

std::string writeFormula(const ExpressionGraph& graph, int id, const std::vector<std::string>& variables,
                         const std::vector<std::string>& parameters, std::size_t most) {
  // Precedence: 0 sum, 1 product, 2 sign, 3 power, 4 atom.
  const auto write = [&](const auto& self, int node, int outer, int depth) -> std::string {
    if (depth > 24) return "…";
    const ExpressionNode& n = graph.node(node);
    const auto part = [&](int operand, int precedence) { return self(self, operand, precedence, depth + 1); };
    std::string text;
    int own = 4;
    switch (n.op) {
      case Op::Constant:
        text = n.value == std::numbers::pi ? "pi" : fmt::format("{:.6g}", n.value);
        if (n.value < 0) own = 2;
        break;
      case Op::Variable: text = variables[n.a]; break;
      case Op::Parameter: text = parameters[n.a]; break;
      case Op::Add: text = part(n.a, 0) + " + " + part(n.b, 1), own = 0; break;
      case Op::Sub: text = part(n.a, 0) + " - " + part(n.b, 1), own = 0; break;
      case Op::Mul: text = part(n.a, 1) + "*" + part(n.b, 2), own = 1; break;
      case Op::Div: text = part(n.a, 1) + "/" + part(n.b, 2), own = 1; break;
      case Op::Neg: text = "-" + part(n.a, 2), own = 2; break;
      case Op::PowInt: text = part(n.a, 4) + fmt::format("^{}", n.b), own = 3; break;
      case Op::Pow: text = part(n.a, 4) + "^" + part(n.b, 4), own = 3; break;
      case Op::Atan2: text = "atan2(" + part(n.a, 0) + ", " + part(n.b, 0) + ")"; break;
      default: text = std::string(nameOf(n.op)) + "(" + part(n.a, 0) + ")";
    }
    return own < outer ? "(" + text + ")" : text;
  };
  std::string text = write(write, id, 0, 0);
  if (text.size() > most) text = text.substr(0, most) + "…";
  return text;
}

}  // namespace reachlab::constraints
