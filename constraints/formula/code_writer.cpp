#include <fmt/format.h>

#include <array>

#include "constraints/formula/cpp_writer.h"

namespace reachlab::constraints {
namespace {

const std::vector<std::string> kCurveMembers{"r", "rPhi", "rPhiPhi"};
const std::vector<std::string> kSurfaceMembers{"r", "rU", "rV", "rUu", "rUv", "rVv"};

std::string indented(const std::string& lines) {
  std::string result;
  std::size_t start = 0;
  while (start < lines.size()) {
    const std::size_t end = lines.find('\n', start);
    result += "  " + lines.substr(start, end - start) + "\n";
    start = end + 1;
  }
  return result;
}

std::vector<std::string> identifiersFor(const std::vector<std::string>& parameters, std::vector<std::string> taken) {
  std::vector<std::string> result;
  for (const std::string& name : parameters) {
    result.push_back(cppIdentifier(name, taken));
    taken.push_back(result.back());
  }
  return result;
}

int dotOf(ExpressionGraph& graph, const int* a, const int* b) {
  return graph.add(graph.add(graph.mul(a[0], b[0]), graph.mul(a[1], b[1])), graph.mul(a[2], b[2]));
}

std::string formulaLine(const FormulaText& text) {
  return "{" + text.coordinates[0] + ", " + text.coordinates[1] + ", " + text.coordinates[2] + "}";
}

/// What the evaluators of one formula have in common.
class EvaluatorText {
 public:
  EvaluatorText(const CompiledFormula& formula, const std::string& sinCos)
      : graph_(formula.graph), names_{variablesOf(formula.text.kind), identifiersFor(formula.text.parameters, kTaken), sinCos},
        writer_(graph_, formula.roots, names_) {}
  /// The shape's numbers by name.
  std::string shape() const {
    std::string text;
    for (std::size_t i = 0; i < names_.parameters.size(); ++i)
      text += fmt::format("const double {} = shape[{}];\n", names_.parameters[i], i);
    return text;
  }
  const std::string& statements() const { return writer_.statements(); }
  std::string expression(std::size_t root) const { return writer_.expression(root); }

 private:
  inline static const std::vector<std::string> kTaken{"phi", "phis", "u", "v", "p", "shape", "lane", "far"};
  ExpressionGraph graph_;
  CppWriter::Names names_;
  CppWriter writer_;
};

}  // namespace

std::string writeEvaluator(const CompiledFormula& formula, const std::string& functionName) {
  const bool curve = formula.text.kind == ConstraintKind::Curve;
  const EvaluatorText text(formula, "sinCos");
  std::string body = text.shape() + text.statements();
  const std::vector<std::string>& members = curve ? kCurveMembers : kSurfaceMembers;
  for (std::size_t k = 0; k < members.size(); ++k)
    body +=
        fmt::format("p.{} = {{{}, {}, {}}};\n", members[k], text.expression(3 * k), text.expression(3 * k + 1), text.expression(3 * k + 2));
  const std::string variables =
      curve ? "[[maybe_unused]] double phi, CurvePoint& p" : "[[maybe_unused]] double u, [[maybe_unused]] double v, SurfacePoint& p";
  return fmt::format("// {}\nvoid {}(const void*, [[maybe_unused]] const double* shape, {}) noexcept {{\n{}}}\n", formulaLine(formula.text),
                     functionName, variables, indented(body));
}

std::string writeBatchEvaluator(const CompiledFormula& formula, const std::string& functionName) {
  const EvaluatorText text(formula, "far |= sinCosNear");
  std::string loop = "[[maybe_unused]] const double phi = phis[lane];\n" + text.statements();
  for (std::size_t k = 0; k < 9; ++k) loop += fmt::format("p.{}[{}][lane] = {};\n", kCurveMembers[k / 3], k % 3, text.expression(k));
  const std::string body = text.shape() + "std::uint64_t far = 0;\nfor (int lane = 0; lane < kBatchLanes; ++lane) {\n" + indented(loop) +
                           "}\n" + fmt::format("if (far != 0) evaluateSingly({}, nullptr, shape, phis, p);\n", functionName);
  return fmt::format(
      "void {}Batch(const void*, const double* shape, const double* __restrict phis, CurveBatch& __restrict p) noexcept {{\n{}}}\n",
      functionName, indented(body));
}

std::string writeDynamicsCode(const CompiledFormula& formula, const std::string& name, const std::vector<double>& defaults) {
  const bool curve = formula.text.kind == ConstraintKind::Curve;
  ExpressionGraph graph = formula.graph;
  // What the dynamics need besides the shape: parameters of the graph after the formula's own.
  const std::vector<std::string> given =
      curve ? std::vector<std::string>{"fx", "fy", "fz", "m", "lambda"} : std::vector<std::string>{"fx", "fy", "fz", "uRate", "vRate"};
  const int first = static_cast<int>(formula.text.parameters.size());
  const auto extra = [&](int k) { return graph.parameter(first + k); };
  const std::array<int, 3> force{extra(0), extra(1), extra(2)};

  std::vector<int> roots(formula.roots.begin(), formula.roots.begin() + 3);
  std::vector<std::string> outputs{"x", "y", "z"};
  const auto put = [&](const std::string& output, int node) {
    outputs.push_back(output);
    roots.push_back(node);
  };
  const int* r = formula.roots.data();
  if (curve) {
    const int m = extra(3), lambda = extra(4);
    const int square = dotOf(graph, r + 3, r + 3);
    put("M", graph.mul(m, square));
    put("L", graph.mul(lambda, square));
    put("V", graph.mul(m, dotOf(graph, r + 3, r + 6)));
    put("Q", dotOf(graph, r + 3, force.data()));
  } else {
    const int *rU = r + 3, *rV = r + 6;
    const int uRate = extra(3), vRate = extra(4);
    std::array<int, 3> w{};
    for (int k = 0; k < 3; ++k) {
      const int square = graph.add(graph.mul(r[9 + k], graph.powInt(uRate, 2)), graph.mul(r[15 + k], graph.powInt(vRate, 2)));
      w[k] = graph.add(square, graph.mul(graph.constant(2), graph.mul(r[12 + k], graph.mul(uRate, vRate))));
    }
    put("G11", dotOf(graph, rU, rU));
    put("G12", dotOf(graph, rU, rV));
    put("G22", dotOf(graph, rV, rV));
    put("C1", dotOf(graph, rU, w.data()));
    put("C2", dotOf(graph, rV, w.data()));
    put("Q1", dotOf(graph, rU, force.data()));
    put("Q2", dotOf(graph, rV, force.data()));
  }

  CppWriter::Names names;
  names.variables = variablesOf(formula.text.kind);
  std::vector<std::string> taken = names.variables;
  taken.insert(taken.end(), given.begin(), given.end());
  taken.insert(taken.end(), outputs.begin(), outputs.end());
  taken.insert(taken.end(), {"out", "std", "signOf"});
  const std::vector<std::string> shape = identifiersFor(formula.text.parameters, taken);
  names.parameters = shape;
  names.parameters.insert(names.parameters.end(), given.begin(), given.end());
  const CppWriter writer(graph, roots, names);

  const std::string type = upperCamel(name) + "Dynamics";
  std::string code = "#include <cmath>\n\n";
  code += fmt::format("// {}: r({}) = {}  [m]\n", name, curve ? "phi" : "u, v", formulaLine(formula.text));
  code += curve ? "// M phi'' + L phi' + V phi'^2 = Q for a mass m in a field of viscosity lambda under the force f.\n"
                : "// m G q'' + lambda G q' + m C = Q, q = (u, v), for a mass m in a field of viscosity lambda under the force f.\n";
  code += "struct " + type + " {\n  double ";
  for (std::size_t k = 0; k < outputs.size(); ++k) code += (k == 0 ? "" : ", ") + outputs[k];
  code += ";\n};\n\n";
  std::string body = "/*----- " + std::string(curve ? "Curve" : "Surface") + " coordinates and dynamic parameters -----*/\n";
  body += writer.statements() + type + " out;\n";
  for (std::size_t k = 0; k < outputs.size(); ++k) body += fmt::format("out.{} = {};\n", outputs[k], writer.expression(k));
  body += "return out;\n/*----- END OF CODE -----*/\n";
  if (body.find("signOf(") != std::string::npos) code += "inline double signOf(double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : x; }\n\n";
  code += "inline " + type + " compute" + type + "(";
  for (const std::string& variable : names.variables) code += "[[maybe_unused]] double " + variable + ", ";
  for (std::size_t k = 0; k < given.size(); ++k) code += (k == 0 ? "[[maybe_unused]] double " : ", [[maybe_unused]] double ") + given[k];
  for (std::size_t k = 0; k < shape.size(); ++k) {
    code += ", double " + shape[k];
    if (k < defaults.size()) code += fmt::format(" = {}", defaults[k]);
  }
  return code + ") {\n" + indented(body) + "}\n";
}

}  // namespace reachlab::constraints
