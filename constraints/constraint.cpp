#include "constraints/constraint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/definition.h"
#include "constraints/analysis.h"
#include "base/error.h"
#include "base/names.h"
#include "constraints/places.h"
#include "constraints/surface_branches.h"

namespace reachlab::constraints {
namespace {

Constraint assemble(std::shared_ptr<const CompiledFormula> formula, const std::array<double, kMaxShapeParameters>& shape,
                    const GeneratedFunctions& generated) {
  Constraint c;
  c.kind = formula->text.kind;
  if (c.kind == ConstraintKind::Curve)
    c.curve = generated.curve != nullptr ? Curve{generated.curve, generated.curveOctet, nullptr, shape}
                                         : Curve{evaluateCurveProgram, evaluateCurveOctetProgram, &formula->program, shape};
  else
    c.surface = generated.surface != nullptr ? Surface{generated.surface, nullptr, shape}
                                             : Surface{evaluateSurfaceProgram, &formula->program, shape};
  c.straight = formula->straight;
  c.owner = std::move(formula);
  return c;
}

/// The first place in the range that no mass can cross, in words; empty if there is none.
std::string findBarrier(const Constraint& c, const std::array<Domain, 2>& range) {
  if (c.kind != ConstraintKind::Curve || !(range[0].lo < range[0].hi)) return {};
  const CurveRegularity regularity = computeRegularityWithin(c, range[0].lo, range[0].hi);
  for (const Place& place : regularity.places)
    if (!isPassed(place.kind))
      return place.kind == PlaceKind::Jump
                 ? describe(place, c.kind)
                 : fmt::format("not finite at phi = {:.9g}: {} of {}", place.at, nameOf(place.kind), place.because);
  if (regularity.lo > range[0].lo || regularity.hi < range[0].hi)
    return fmt::format("the formula could be examined from phi = {:.6g} to {:.6g} only", regularity.lo, regularity.hi);
  return {};
}

void requireMoving(const Constraint& c, const std::array<Domain, 2>& range, const std::string& origin) {
  // A path along a pole's line sees nothing but the pole: the surface as a whole decides.
  if (degeneratesEverywhere(c, range) && degeneratesEverywhere(c, boundedDomain(c)))
    throw UsageError(origin + (c.kind == ConstraintKind::Curve
                                   ? ": degenerates everywhere: r_phi is zero at every phi; allowed: a formula that moves with phi"
                                   : ": degenerates everywhere: r_u x r_v is zero at every u, v; allowed: a formula that spans a surface"));
}

void requireUsable(const Constraint& c, const std::array<Domain, 2>& range, bool watched, const std::string& origin) {
  if (const std::string place = findBarrier(c, range); !place.empty())
    throw UsageError(origin + ": " + place +
                     ", which no mass can cross; allowed: a range (from start to target, or the domain) without such a place");
  // Places with a limit, and a surface's ends, are met as a mass moves.
  const bool passed = c.kind == ConstraintKind::Curve
                          ? range[0].lo < range[0].hi && !computeRegularityWithin(c, range[0].lo, range[0].hi).places.empty()
                          : watched && !computeBranches(c)->smooth();
  if (const std::string place = passed ? "" : findNonFinite(c, range); !place.empty())
    throw UsageError(origin + ": " + place + "; allowed: a formula that is finite, with its first and second derivatives, on its domain");
  requireMoving(c, range, origin);
}

}  // namespace

std::array<double, kMaxShapeParameters> shapeOf(const Definition& definition, const std::map<std::string, double>& shape,
                                                const std::string& origin) {
  std::array<double, kMaxShapeParameters> values{};
  const FormulaText text = formulaOf(definition);
  std::string faults;
  const auto fault = [&](const std::string& what) { faults += (faults.empty() ? "" : "\n") + origin + ": " + what; };
  for (const auto& [key, value] : shape) {
    std::size_t i = 0;
    while (i < definition.shape.size() && definition.shape[i].name != key) ++i;
    if (i == definition.shape.size()) {
      const std::string near = nearestName(key, text.parameters);
      fault("shape." + key.substr(0, 40) + ": " + definition.name + " has no such parameter; allowed: " +
            (text.parameters.empty() ? "none" : listOf(text.parameters)) + (near.empty() ? "" : "; did you mean " + near + "?"));
    }
  }
  for (std::size_t i = 0; i < definition.shape.size() && i < kMaxShapeParameters; ++i) {
    const ShapeParameter& p = definition.shape[i];
    const auto given = shape.find(p.name);
    values[i] = given == shape.end() ? p.defaultValue : given->second;
    if (!(values[i] >= p.min && values[i] <= p.max))
      fault("shape." + p.name + ": " + fmt::format("{}", values[i]) + " is out of range; allowed: " + fmt::format("{}", p.min) + " to " +
            fmt::format("{}", p.max) + (p.unit == "1" ? "" : " " + p.unit));
    else if (p.whole && values[i] != std::floor(values[i]))
      fault("shape." + p.name + ": " + fmt::format("{}", values[i]) + " is not whole; allowed: a whole number");
  }
  if (!faults.empty()) throw UsageError(faults);
  return values;
}

Constraint makeConstraint(const Definition& definition, const std::map<std::string, double>& shape, const std::string& origin) {
  const std::array<double, kMaxShapeParameters> values = shapeOf(definition, shape, origin);
  Constraint c = assemble(compileFormula(formulaOf(definition), origin), values, generatedFunctions(definition));
  c.name = definition.name;
  c.domain = domainOf(definition, values);
  requireUsable(c, boundedDomain(c), false, origin);
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
    return makeConstraint(spec.definition.empty() ? findDefinition(spec.name, origin) : parseDefinition(spec.definition, origin),
                          spec.shape, origin);
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
    if (!std::isfinite(value))
      faults += (faults.empty() ? "" : "\n") + origin + ": shape." + key + ": is not finite; allowed: a finite number";
  }
  if (!faults.empty()) throw UsageError(faults);
  Constraint c = assemble(compileFormula(text, origin), values, {});
  c.name = text.kind == ConstraintKind::Curve ? "curve" : "surface";
  // Without a task nobody knows yet where a mass will be: its start decides.
  if (spec.inUse) requireUsable(c, *spec.inUse, true, origin);
  else requireMoving(c, boundedDomain(c), origin);
  return c;
}

}  // namespace reachlab::constraints
