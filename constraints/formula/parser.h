#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "constraints/formula/expression.h"

namespace reachlab::constraints {

inline constexpr std::size_t kMaxFormulaCharacters = 2000;
inline constexpr int kMaxFormulaDepth = 100;

/// A syntax fault of a formula with its position: `position` counts bytes from 0, `character` counts characters from 1.
struct FormulaFault {
  int coordinate = 0;        // 0 x, 1 y, 2 z
  std::size_t position = 0;  // byte of the formula at which it went wrong (its length: at the end)
  std::size_t character = 1;
  std::string what = {};     // "unknown name 'phj'; expected phi, a, b, a constant or a function; did you mean phi?"
  std::string allowed = {};  // empty where `what` says it all
};

/// Names a formula may use besides `pi`, `e` and the functions.
struct FormulaNames {
  std::vector<std::string> variables;   // {"phi"} or {"u", "v"}
  std::vector<std::string> parameters;  // of the shape
};

struct ParsedFormula {
  int root = -1;  // in the graph; -1 with a fault
  std::optional<FormulaFault> fault;
  std::vector<bool> used;  // which parameters it names
};

/// Reads one line of infix text into the graph: `+ - * / ^`, unary minus, parentheses, pi, e, functions, names. -x^2 is -(x^2), and ^
/// groups to the right: 2^3^2 = 2^9. There is no implicit multiplication. At most kMaxFormulaCharacters characters and kMaxFormulaDepth
/// levels of nesting. No text makes it recurse or allocate beyond that.
ParsedFormula parseFormula(std::string_view text, const FormulaNames& names, ExpressionGraph& graph);

/// The reason why `name` cannot name a shape parameter: it is no name, or clashes with a variable, constant or function. Empty if it can.
std::optional<FormulaFault> parameterNameFault(const std::string& name, const std::vector<std::string>& variables);

}  // namespace reachlab::constraints
