#include "constraints/formula/cpp_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reachlab::constraints {
namespace {

// Words that a shape parameter may be called but a C++ variable may not.
const std::vector<std::string> kReserved{
    "alignas", "alignof", "and", "asm", "auto", "bool", "break", "case", "catch", "char", "class", "compl", "concept", "const", "continue",
    "default", "delete", "do", "double", "else", "enum", "explicit", "export", "extern", "false", "float", "for", "friend", "goto", "if",
    "inline", "int", "long", "mutable", "namespace", "new", "noexcept", "not", "nullptr", "operator", "or", "private", "protected",
    "public", "register", "requires", "return", "short", "signed", "sizeof", "static", "struct", "switch", "template", "this", "throw",
    "true", "try", "typedef", "typeid", "typename", "union", "unsigned", "using", "virtual", "void", "volatile", "while", "xor",
    // macros of <math.h> on common systems
    "NAN", "INFINITY", "HUGE_VAL", "NULL", "EOF", "unix", "linux"};

std::string numberText(double value) {
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return value > 0 ? "INFINITY" : "-INFINITY";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

}  // namespace

std::string cppIdentifier(const std::string& name, const std::vector<std::string>& taken) {
  std::string result = name;
  const auto clashes = [&] {
    return std::find(kReserved.begin(), kReserved.end(), result) != kReserved.end() ||
           std::find(taken.begin(), taken.end(), result) != taken.end();
  };
  if (result.front() == '_' || result.find("__") != std::string::npos) {  // reserved to the implementation
    result.insert(0, "shape");
    for (std::size_t at; (at = result.find("__")) != std::string::npos;) result.erase(at, 1);
  }
  while (clashes()) result += "Shape";
  return result;
}

std::string upperCamel(const std::string& name) {
  std::string result;
  bool upper = true;
  for (const char c : name) {
    if (c == '-') {
      upper = true;
    } else {
      result += upper ? capitalised(std::string(1, c)) : std::string(1, c);
      upper = false;
    }
  }
  return result;
}

CppWriter::CppWriter(ExpressionGraph& graph, const std::vector<int>& roots, Names names)
    : graph_(graph), names_(std::move(names)), roots_(graph.expandPowers(roots)) {
  taken_ = names_.variables;
  taken_.insert(taken_.end(), names_.parameters.begin(), names_.parameters.end());
  const std::vector<bool> needed = graph.reachableFrom(roots_);
  std::vector<int> uses = graph.countUses(roots_);
  for (const int root : roots_) ++uses[root];
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const int id = static_cast<int>(i);
    if (!needed[i] || operandCount(graph.node(id).op) == 0) continue;
    const Op op = graph.node(id).op;
    if (op == Op::Sin || op == Op::Cos) {
      nameWave(id);
    } else if (uses[i] > 1) {
      const std::string text = operation(id).text;
      const std::string name = freshName(fmt::format("t{}", ++temporaries_));
      statements_ += fmt::format("const double {} = {};\n", name, text);
      named_[id] = name;
    }
  }
}

std::string CppWriter::freshName(std::string name) const {
  while (std::find(taken_.begin(), taken_.end(), name) != taken_.end()) name += "_";
  return name;
}

// sin(phi) is called sinPhi, sin(4 phi) sin4Phi, others by number.
std::string CppWriter::waveSuffix(int argument) {
  const ExpressionNode& n = graph_.node(argument);
  if (n.op == Op::Variable) return capitalised(names_.variables[n.a]);
  if (n.op == Op::Mul && graph_.isConstant(n.a) && graph_.node(n.b).op == Op::Variable) {
    const double factor = graph_.node(n.a).value;
    if (factor == std::floor(factor) && factor < 1000)
      return fmt::format("{}{}", factor, capitalised(names_.variables[graph_.node(n.b).a]));
  }
  return fmt::format("T{}", ++temporaries_);
}

void CppWriter::nameWave(int id) {
  if (named_.count(id) != 0) return;
  const int argument = graph_.node(id).a;
  const std::string inner = print(argument).text;
  const std::string suffix = waveSuffix(argument);
  if (names_.sinCos.empty()) {
    const bool isSine = graph_.node(id).op == Op::Sin;
    named_[id] = freshName((isSine ? "sin" : "cos") + suffix);
    statements_ += fmt::format("const double {} = std::{}({});\n", named_[id], isSine ? "sin" : "cos", inner);
    return;
  }
  const std::string sine = freshName("sin" + suffix), cosine = freshName("cos" + suffix);
  statements_ += fmt::format("double {0}, {1};\n{3}({2}, {0}, {1});\n", sine, cosine, inner, names_.sinCos);
  for (int other = 0; other < graph_.size(); ++other) {
    const ExpressionNode& n = graph_.node(other);
    if (n.op == Op::Sin && n.a == argument) named_[other] = sine;
    if (n.op == Op::Cos && n.a == argument) named_[other] = cosine;
  }
}

CppWriter::Text CppWriter::print(int id) const {
  if (const auto found = named_.find(id); found != named_.end()) return {found->second, 3};
  const ExpressionNode& n = graph_.node(id);
  if (n.op == Op::Constant) return {numberText(n.value), n.value < 0 ? 2 : 3};
  if (n.op == Op::Variable) return {names_.variables[n.a], 3};
  if (n.op == Op::Parameter) return {names_.parameters[n.a], 3};
  return operation(id);
}

CppWriter::Text CppWriter::operation(int id) const {
  const ExpressionNode& n = graph_.node(id);
  const auto atLeast = [&](int operand, int precedence) {
    const Text t = print(operand);
    return t.precedence >= precedence ? t.text : "(" + t.text + ")";
  };
  switch (n.op) {
    case Op::Add: return {atLeast(n.a, 0) + " + " + atLeast(n.b, 1), 0};
    case Op::Sub: return {atLeast(n.a, 0) + " - " + atLeast(n.b, 1), 0};
    case Op::Mul: return {atLeast(n.a, 1) + " * " + atLeast(n.b, 2), 1};
    case Op::Div: return {atLeast(n.a, 1) + " / " + atLeast(n.b, 2), 1};
    case Op::Neg: return {"-" + atLeast(n.a, 3), 2};
    default: return {function(n), 3};
  }
}

std::string CppWriter::function(const ExpressionNode& n) const {
  const std::string a = print(n.a).text;
  const std::string from = names_.sinCos.empty() || n.op == Op::Sqrt || n.op == Op::Abs ? "std::" : "elementary::";
  switch (n.op) {
    case Op::Pow: return from + "pow(" + a + ", " + print(n.b).text + ")";
    case Op::Atan2: return from + "atan2(" + a + ", " + print(n.b).text + ")";
    case Op::Sign: return "signOf(" + a + ")";
    default: return from + nameOf(n.op) + "(" + a + ")";
  }
}

std::string CppWriter::expression(std::size_t k) const { return print(roots_[k]).text; }

}  // namespace reachlab::constraints
