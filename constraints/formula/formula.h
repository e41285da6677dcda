#pragma once
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/fault.h"
#include "constraints/constraint_spec.h"
#include "constraints/formula/expression.h"
#include "constraints/formula/parser.h"
#include "constraints/formula/program.h"

namespace reachlab::constraints {

/// A curve or surface as text: one line per coordinate, in `phi` or in `u` and `v`, with named parameters.
struct FormulaText {
  ConstraintKind kind = ConstraintKind::Curve;
  std::array<std::string, 3> coordinates;
  std::vector<std::string> parameters;  // in the order of the shape array; at most kMaxShapeParameters
};

/// A formula after the whole pipeline: text, shared graph, exact derivatives, program. Immutable. Any thread.
struct CompiledFormula {
  FormulaText text;
  ExpressionGraph graph;
  /// Nodes in the order of CurvePoint's or SurfacePoint's members: 9 or 18.
  std::vector<int> roots;
  std::span<const int> place() const { return std::span(roots).first(3); }  // nodes of r
  Program program;
  bool straight = false;  // a curve with constant r_phi
};

std::vector<std::string> variablesOf(ConstraintKind kind);

/// Every fault of the text: syntax with its place, names, parameters that no coordinate uses. Empty when fine. For live checking.
std::vector<FormulaFault> formulaFaults(const FormulaText& text);

/// The same for a file or an editor, under `key`: "constraint.curve[1]", the place being a character of that text.
Fault toFault(const FormulaFault& fault, ConstraintKind kind, const std::string& key);

/// Throws FaultError with every fault, each under `key`.
std::shared_ptr<const CompiledFormula> compileFormula(const FormulaText& text, const std::string& key);

/// r (three nodes) and its first and second derivatives, in the order of CurvePoint's or SurfacePoint's members. Adds nodes.
std::vector<int> withDerivatives(ExpressionGraph& graph, std::span<const int> r, ConstraintKind kind);

/// Values of graph nodes, with the operations of the compiled forms. Allocates: not for the haptic thread.
std::vector<double> evaluateNodes(const ExpressionGraph& graph, std::span<const int> roots, const double* shape, const double* variables);
inline double evaluateNode(const ExpressionGraph& graph, int root, const double* shape, const double* variables) {
  return evaluateNodes(graph, std::span(&root, 1), shape, variables)[0];
}

}  // namespace reachlab::constraints
