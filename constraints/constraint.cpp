#include "constraints/constraint.h"

#include <cmath>

#include "constraints/definition.h"
#include "constraints/error.h"

namespace reachlab {
namespace {

std::string numberText(double value) {
  std::string text = std::to_string(value);
  while (text.find('.') != std::string::npos && (text.back() == '0' || text.back() == '.')) {
    const bool point = text.back() == '.';
    text.pop_back();
    if (point) break;
  }
  return text;
}

Constraint assemble(std::shared_ptr<const CompiledFormula> formula, const std::array<double, kMaxShapeParameters>& shape,
                    const GeneratedFunctions& generated) {
  Constraint c;
  c.kind = formula->text.kind;
  if (c.kind == ConstraintKind::Curve)
    c.curve = generated.curve != nullptr ? Curve{generated.curve, nullptr, shape} : Curve{evaluateCurveProgram, &formula->program, shape};
  else
    c.surface = generated.surface != nullptr ? Surface{generated.surface, nullptr, shape}
                                             : Surface{evaluateSurfaceProgram, &formula->program, shape};
  c.straight = formula->straight;
  c.owner = std::move(formula);
  return c;
}

}  // namespace

FormulaText formulaOf(const Definition& definition) {
  FormulaText text{definition.kind, definition.coordinates, {}};
  for (const ShapeParameter& p : definition.shape) text.parameters.push_back(p.name);
  return text;
}

std::array<double, kMaxShapeParameters> shapeOf(const Definition& definition, const std::map<std::string, double>& shape, const std::string& origin) {
  std::array<double, kMaxShapeParameters> values{};
  const FormulaText text = formulaOf(definition);
  std::string faults;
  const auto fault = [&](const std::string& what) { faults += (faults.empty() ? "" : "\n") + origin + ": " + what; };
  for (const auto& [key, value] : shape) {
    std::size_t i = 0;
    while (i < definition.shape.size() && definition.shape[i].name != key) ++i;
    if (i == definition.shape.size()) {
      const std::string near = closestName(key, text.parameters);
      fault("shape." + key.substr(0, 40) + ": " + definition.name + " has no such parameter; allowed: " +
            (text.parameters.empty() ? "none" : joinNames(text.parameters)) + (near.empty() ? "" : "; did you mean " + near + "?"));
    }
  }
  for (std::size_t i = 0; i < definition.shape.size() && i < kMaxShapeParameters; ++i) {
    const ShapeParameter& p = definition.shape[i];
    const auto given = shape.find(p.name);
    values[i] = given == shape.end() ? p.defaultValue : given->second;
    if (!(values[i] >= p.min && values[i] <= p.max))
      fault("shape." + p.name + ": " + numberText(values[i]) + " is out of range; allowed: " + numberText(p.min) + " to " + numberText(p.max) +
            (p.unit == "1" ? "" : " " + p.unit));
  }
  if (!faults.empty()) throw UsageError(faults);
  return values;
}

double constantOf(const std::string& expression, const FormulaText& names, const std::array<double, kMaxShapeParameters>& shape,
                  const std::string& origin) {
  ExpressionGraph graph;
  const ParsedFormula parsed = parseFormula(expression, {{}, names.parameters}, graph);
  if (parsed.fault) throw UsageError(origin + ", character " + std::to_string(parsed.fault->character) + ": " + parsed.fault->what);
  const double value = evaluateNodes(graph, std::array{parsed.root}, shape.data(), nullptr)[0];
  if (!std::isfinite(value)) throw UsageError(origin + ": is not finite; allowed: a finite number");
  return value;
}

std::array<Domain, 2> domainOf(const Definition& definition, const std::array<double, kMaxShapeParameters>& shape) {
  std::array<Domain, 2> domain;
  const FormulaText names = formulaOf(definition);
  for (std::size_t k = 0; k < 2; ++k) {
    const DomainText& text = definition.domain[k];
    if (!text.lo.empty()) domain[k].lo = constantOf(text.lo, names, shape, definition.name + ": domain");
    if (!text.hi.empty()) domain[k].hi = constantOf(text.hi, names, shape, definition.name + ": domain");
    domain[k].periodic = text.periodic;
    domain[k].atEnd = text.atEnd;
  }
  return domain;
}

Constraint makeConstraint(const Definition& definition, const std::map<std::string, double>& shape, const std::string& origin) {
  const std::array<double, kMaxShapeParameters> values = shapeOf(definition, shape, origin);
  Constraint c = assemble(compileFormula(formulaOf(definition), origin), values, generatedFunctions(definition));
  c.name = definition.name;
  c.domain = domainOf(definition, values);
  return c;
}

Constraint makeConstraint(const ConstraintSpec& spec, const std::string& origin) {
  if (spec.curve.empty() && spec.surface.empty()) {
    if (spec.name == "free") {
      if (!spec.shape.empty()) throw UsageError(origin + ": shape: free has no shape; allowed: no shape");
      Constraint c;
      c.name = "free";
      return c;
    }
    if (const Definition* definition = findInCatalogue(spec.name)) return makeConstraint(*definition, spec.shape, origin);
    std::vector<std::string> known{"free"};
    for (const Definition& definition : catalogue()) known.push_back(definition.name);
    const std::string near = closestName(spec.name, known);
    throw UsageError(origin + ": there is no constraint '" + spec.name.substr(0, 60) + "'; allowed: the names that `reach list constraints` tells" +
                     (near.empty() ? "" : "; did you mean " + near + "?"));
  }
  const std::vector<std::string>& lines = spec.curve.empty() ? spec.surface : spec.curve;
  if (lines.size() != 3) throw UsageError(origin + ": has " + std::to_string(lines.size()) + " formulas; allowed: three, one a coordinate");
  FormulaText text;
  text.kind = spec.curve.empty() ? ConstraintKind::Surface : ConstraintKind::Curve;
  std::copy(lines.begin(), lines.end(), text.coordinates.begin());
  std::array<double, kMaxShapeParameters> values{};
  std::string faults;
  for (const auto& [key, value] : spec.shape) {
    if (text.parameters.size() < kMaxShapeParameters) values[text.parameters.size()] = value;
    text.parameters.push_back(key);
    if (!std::isfinite(value)) faults += (faults.empty() ? "" : "\n") + origin + ": shape." + key + ": is not finite; allowed: a finite number";
  }
  if (!faults.empty()) throw UsageError(faults);
  Constraint c = assemble(compileFormula(text, origin), values, {});
  c.name = text.kind == ConstraintKind::Curve ? "curve" : "surface";
  return c;
}

}  // namespace reachlab
