#pragma once
#include <map>
#include <string>
#include <vector>

#include "constraints/formula/formula.h"

namespace reachlab::constraints {

/// Prints graph nodes as C++. A node that is used more than once becomes a named constant (sinPhi, cos4Phi, t1 …), and any other node is
/// printed where it is used. The operations and their order are those of the interpreter.
class CppWriter {
 public:
  struct Names {
    std::vector<std::string> variables, parameters;  // C++ identifiers
    // The call for sine and cosine at once, from sincos.h. If empty, the code is self-contained and calls std::sin and similar functions.
    std::string sinCos;
  };
  /// `roots` will be asked for by expression(). Integer powers become products in `graph`.
  CppWriter(ExpressionGraph& graph, const std::vector<int>& roots, Names names);

  /// The named constants, a line each.
  const std::string& statements() const { return statements_; }
  /// Root k as an expression.
  std::string expression(std::size_t k) const;

 private:
  struct Text {
    std::string text;
    int precedence;  // 0 sum, 1 product, 2 sign, 3 atom
  };
  Text print(int id) const;
  Text operation(int id) const;
  std::string function(const ExpressionNode& n) const;
  std::string waveSuffix(int argument);
  std::string freshName(std::string name) const;
  void nameWave(int id);

  const ExpressionGraph& graph_;
  Names names_;
  std::vector<int> roots_;
  std::map<int, std::string> named_;
  std::vector<std::string> taken_;
  std::string statements_;
  int temporaries_ = 0;
};

/// An identifier for a shape parameter that clashes with neither C++ nor the names in `taken`.
std::string cppIdentifier(const std::string& name, const std::vector<std::string>& taken);

/// The function of a catalogue entry, `evaluate<Name>` in UpperCamel, with the signature of CurveFunction or SurfaceFunction.
std::string writeEvaluator(const CompiledFormula& formula, const std::string& functionName);
/// The same for a curve at eight parameter values, `<functionName>Batch`, with the signature of CurveBatchFunction. It must follow the
/// single form in the file.
std::string writeBatchEvaluator(const CompiledFormula& formula, const std::string& functionName);

/// A self-contained C++ function with the coordinates, the derivatives and the coefficients of the dynamic equations: M, L, V, Q of
/// Eq. (11) for a curve, G, C, Q of Eq. (13) for a surface, simplified as expressions of m, lambda and the force.
std::string writeDynamicsCode(const CompiledFormula& formula, const std::string& name, const std::vector<double>& defaults);

/// "spherical-spiral" as SphericalSpiral.
std::string upperCamel(const std::string& name);

}  // namespace reachlab::constraints
