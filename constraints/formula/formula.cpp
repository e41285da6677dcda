#include "constraints/formula/formula.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "base/fault.h"
#include "constraints/formula/guards.h"
#include "constraints/formula/watch_compilations.h"

namespace reachlab::constraints {
namespace {

struct Parsed {
  std::array<int, 3> roots{-1, -1, -1};
  std::vector<FormulaFault> faults;
};

// What cancels out takes the end of its domain with it: 0*log(phi) would go on below 0, where the formula as written has no value.
std::optional<FormulaFault> cancelledEnd(const ExpressionGraph& graph, const std::array<int, 3>& roots, const std::array<int, 3>& sizes,
                                         const FormulaNames& names) {
  const std::vector<bool> needed = graph.reachableFrom(roots), moving = findMoving(graph);
  for (int id = 0; id < graph.size(); ++id) {
    if (needed[id] || !moving[id]) continue;
    const ExpressionNode& n = graph.node(id);
    const bool endsBelowZero = (n.op == Op::Log || n.op == Op::Sqrt || n.op == Op::Pow) && !graph.isNeverNegative(n.a);
    if (n.op != Op::Asin && n.op != Op::Acos && !endsBelowZero) continue;
    const auto coordinate = std::find_if(sizes.begin(), sizes.end(), [&](int size) { return id < size; });
    return FormulaFault{static_cast<int>(coordinate - sizes.begin()), 0, 1,
                        writeFormula(graph, id, names.variables, names.parameters) +
                            " cancels out, and what is left would go on where the formula as written has no value",
                        "a formula without it"};
  }
  return std::nullopt;
}

Parsed parseCoordinates(const FormulaText& text, ExpressionGraph& graph) {
  const FormulaNames names{variablesOf(text.kind), text.parameters};
  Parsed result;
  std::vector<bool> used(text.parameters.size(), false);
  std::array<int, 3> sizes{};  // of the graph, after each coordinate
  for (std::size_t k = 0; k < 3; ++k) {
    ParsedFormula parsed = parseFormula(text.coordinates[k], names, graph);
    result.roots[k] = parsed.root;
    sizes[k] = graph.size();
    for (std::size_t i = 0; i < used.size(); ++i) used[i] = used[i] || parsed.used[i];
    if (parsed.fault) {
      parsed.fault->coordinate = static_cast<int>(k);
      result.faults.push_back(*parsed.fault);
    }
  }
  if (!result.faults.empty()) return result;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<bool> needed = graph.reachableFrom(std::span(&result.roots[k], 1));
    for (std::size_t id = 0; id < needed.size(); ++id) {
      const ExpressionNode& n = graph.node(static_cast<int>(id));
      const bool divided = n.op == Op::Div && graph.isConstant(n.a) && graph.isConstant(n.b);  // by 0: the graph leaves it as it is
      const double value = divided ? graph.node(n.a).value / graph.node(n.b).value : n.value;  // of what is no number itself: 0
      if (needed[id] && !std::isfinite(value)) {
        result.faults.push_back({static_cast<int>(k), 0, 1,
                                 "has no finite value anywhere: a part of it that does not move is not finite (1/0, log(0), the root of a "
                                 "negative number)",
                                 "numbers that have a value"});
        break;
      }
    }
  }
  if (!result.faults.empty()) return result;
  if (std::optional<FormulaFault> fault = cancelledEnd(graph, result.roots, sizes, names)) result.faults.push_back(std::move(*fault));
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i])
      result.faults.push_back({-1, 0, 0, "shape." + text.parameters[i] + " is used by no coordinate", "names that the formula uses"});
  return result;
}

std::vector<FormulaFault> parameterFaults(const FormulaText& text) {
  std::vector<FormulaFault> faults;
  if (text.parameters.size() > kMaxShapeParameters)
    faults.push_back(
        {-1, 0, 0, "has " + std::to_string(text.parameters.size()) + " shape parameters", std::to_string(kMaxShapeParameters)});
  for (const std::string& name : text.parameters)
    if (const auto fault = parameterNameFault(name, variablesOf(text.kind))) faults.push_back(*fault);
  return faults;
}

void append(std::vector<int>& roots, const std::vector<int>& more) { roots.insert(roots.end(), more.begin(), more.end()); }

}  // namespace

std::vector<std::string> variablesOf(ConstraintKind kind) {
  if (kind == ConstraintKind::Curve) return {"phi"};
  if (kind == ConstraintKind::Surface) return {"u", "v"};
  return {};
}

Fault toFault(const FormulaFault& fault, ConstraintKind kind, const std::string& key) {
  const std::string formula = keyIn(key, kind == ConstraintKind::Curve ? "curve" : "surface");
  if (fault.coordinate < 0) return {formula, fault.what, fault.allowed};
  return {formula + "[" + std::to_string(fault.coordinate) + "]", fault.what, fault.allowed,
          FilePlace{{}, 0, static_cast<int>(fault.character)}};
}

std::vector<FormulaFault> formulaFaults(const FormulaText& text) {
  if (std::vector<FormulaFault> faults = parameterFaults(text); !faults.empty()) return faults;
  ExpressionGraph graph;
  return parseCoordinates(text, graph).faults;
}

namespace {
std::atomic<void (*)(const FormulaText&)> watcher{nullptr};
}

void watchCompilations(void (*watch)(const FormulaText& text)) { watcher = watch; }

std::shared_ptr<const CompiledFormula> compileFormula(const FormulaText& text, const std::string& key) {
  if (const auto watch = watcher.load()) watch(text);
  auto formula = std::make_shared<CompiledFormula>();
  formula->text = text;
  ExpressionGraph& graph = formula->graph;
  std::vector<FormulaFault> faults = parameterFaults(text);
  Parsed parsed;
  if (faults.empty()) {
    parsed = parseCoordinates(text, graph);
    faults = parsed.faults;
  }
  if (!faults.empty()) {
    std::vector<Fault> told;
    for (const FormulaFault& fault : faults) told.push_back(toFault(fault, text.kind, key));
    throw FaultError(std::move(told));
  }

  const std::array<int, 3>& r = parsed.roots;
  try {
    formula->roots = withDerivatives(graph, r, text.kind);
  } catch (const FaultError&) {
    if (text.kind != ConstraintKind::Curve) throw;
    throw FaultError(Fault{key, "the formula with its derivatives is too large", "a shorter formula"});
  }
  if (text.kind == ConstraintKind::Curve) {
    const std::span second = std::span(formula->roots).subspan(6);
    // A derivative of 0 says nothing of kinks and jumps: {phi/10, abs(phi), 0} is none, nor is atan2(sin(phi), cos(phi)).
    const std::vector<bool> needed = graph.reachableFrom(r), moving = findMoving(graph);
    bool broken = false;
    for (std::size_t id = 0; id < needed.size(); ++id) {
      const ExpressionNode& n = graph.node(static_cast<int>(id));
      const bool polynomial = n.op == Op::Variable || n.op == Op::Add || n.op == Op::Sub || n.op == Op::Mul || n.op == Op::Neg ||
                              n.op == Op::PowInt || (n.op == Op::Div && !moving[n.b]);
      broken = broken || (needed[id] && moving[id] && !polynomial);
    }
    formula->straight = !broken && std::all_of(second.begin(), second.end(), [&](int id) { return graph.isConstant(id, 0); });
  }
  formula->program =
      compileProgram(graph, formula->roots, static_cast<int>(text.parameters.size()), static_cast<int>(variablesOf(text.kind).size()));
  return formula;
}

std::vector<int> withDerivatives(ExpressionGraph& graph, std::span<const int> r, ConstraintKind kind) {
  std::vector<int> all(r.begin(), r.end());
  const std::vector<int> first = graph.differentiate(r, 0);
  if (kind == ConstraintKind::Curve) {
    append(all, first);
    append(all, graph.differentiate(first, 0));
    return all;
  }
  const std::vector<int> second = graph.differentiate(r, 1);
  for (const auto& part : {first, second, graph.differentiate(first, 0), graph.differentiate(first, 1), graph.differentiate(second, 1)})
    append(all, part);
  return all;
}

std::vector<double> evaluateNodes(const ExpressionGraph& graph, std::span<const int> roots, const double* shape, const double* variables) {
  return madeOfNodes<double>(graph, roots, [&](int, const ExpressionNode& n, const std::vector<double>& values) {
    switch (n.op) {
      case Op::Constant: return n.value;
      case Op::Variable: return variables[n.a];
      case Op::Parameter: return shape[n.a];
      case Op::PowInt: return applyOp(n.op, values[n.a], n.b);
      default: return applyOp(n.op, values[n.a], n.b < 0 ? 0 : values[n.b]);
    }
  });
}

}  // namespace reachlab::constraints
