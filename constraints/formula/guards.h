#pragma once
#include <span>
#include <string>
#include <vector>

#include "constraints/formula/expression.h"

namespace reachlab::constraints {

/// One operation of a formula that is not analytic everywhere: it is, wherever `argument` differs from `level`.
struct Guard {
  Op op = Op::Abs;
  int node = -1;      // the operation itself
  int argument = -1;  // the node that decides
  double level = 0;
  /// abs, sign, atan2: on either side the operation is a formula that runs on smoothly across the place.
  bool branches() const { return op == Op::Abs || op == Op::Sign || op == Op::Atan2; }
};

/// Which nodes change with the variables.
std::vector<bool> findMoving(const ExpressionGraph& graph);

/// Guards of everything the roots need, operands before their users. Operations on numbers and shape alone have no guards. Adds nodes to
/// the graph (the cosine under a tangent). `shape` decides which exponents are whole numbers.
std::vector<Guard> findGuards(ExpressionGraph& graph, std::span<const int> roots, const double* shape);

/// The roots with each branching guard replaced by its branch, on the side where argument - level has the sign `signs[k]`. abs(a) becomes
/// a, 0 or -a. sign(a) becomes that number. atan2(y, x) becomes the form that is continuous across y = 0.
std::vector<int> freezeBranches(ExpressionGraph& graph, std::span<const int> roots, const std::vector<Guard>& guards,
                                const std::vector<int>& signs);

/// The node as the text of a formula, cut at about `most` characters.
std::string writeFormula(const ExpressionGraph& graph, int node, const std::vector<std::string>& variables,
                         const std::vector<std::string>& parameters, std::size_t most = 60);

}  // namespace reachlab::constraints
