#include "constraints/constraint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "base/names.h"
#include "base/number_range.h"
#include "constraints/catalogue/generated_catalogue.h"
#include "constraints/regularity/analysis.h"
#include "constraints/regularity/places.h"
#include "constraints/regularity/surface_branches.h"
#include "constraints/regularity/undefined.h"

namespace reachlab::constraints {
namespace {

Constraint assemble(std::shared_ptr<const CompiledFormula> formula, const std::array<double, kMaxShapeParameters>& shape,
                    const GeneratedFunctions& generated) {
  Constraint c;
  c.kind = formula->text.kind;
  if (c.kind == ConstraintKind::Curve)
    c.curve = generated.curve != nullptr ? Curve{generated.curve, generated.curveBatch, nullptr, shape}
                                         : Curve{evaluateCurveProgram, evaluateCurveBatchProgram, &formula->program, shape};
  else
    c.surface = generated.surface != nullptr ? Surface{generated.surface, nullptr, shape}
                                             : Surface{evaluateSurfaceProgram, &formula->program, shape};
  c.straight = formula->straight;
  c.formula = std::move(formula);
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

void requireMoving(const Constraint& c, const std::array<Domain, 2>& range, const std::string& key) {
  // A path along a pole's line sees nothing but the pole: the surface as a whole decides.
  if (degeneratesEverywhere(c, range) && degeneratesEverywhere(c, boundedDomain(c)))
    throw FaultError(c.kind == ConstraintKind::Curve
                         ? Fault{key, "degenerates everywhere: r_phi is zero at every phi", "a formula that moves with phi"}
                         : Fault{key, "degenerates everywhere: r_u x r_v is zero at every u, v", "a formula that spans a surface"});
}

void requireUsable(const Constraint& c, const std::array<Domain, 2>& range, bool watched, const std::string& key) {
  if (std::optional<Fault> fault = undefinedFault(c, range)) {
    fault->key = key;
    throw FaultError(std::move(*fault));
  }
  if (const std::string place = findBarrier(c, range); !place.empty())
    throw FaultError(Fault{key, place + ", which no mass can cross", "a range (from start to target, or the domain) without such a place"});
  // Places with a limit, and a surface's ends, are met as a mass moves.
  const bool passed = c.kind == ConstraintKind::Curve
                          ? range[0].lo < range[0].hi && !computeRegularityWithin(c, range[0].lo, range[0].hi).places.empty()
                          : watched && !computeBranches(c)->smooth();
  if (const std::string place = passed ? "" : findNonFinite(c, range); !place.empty())
    throw FaultError(Fault{key, place, "a formula that is finite, with its first and second derivatives, on its domain"});
  requireMoving(c, range, key);
}

/// Over a period the parameter runs on, so r has to repeat itself there; on a surface its line may come back the other way round (Moebius).
void requirePeriods(const Constraint& c, const std::string& key) {
  constexpr double kSame = 1e-9;  // of the size
  constexpr int kPlaces = 16;
  const std::array<Domain, 2> range = boundedDomain(c);
  const int parameters = c.parameterCount();
  for (int k = 0; k < parameters; ++k) {
    if (!c.domain[k].periodic) continue;
    const Domain &own = range[k], &other = range[1 - k];
    const auto at = [&](double q, double across) {
      if (parameters == 1) return evaluate(c.curve, q).r;
      return (k == 0 ? evaluate(c.surface, q, across) : evaluate(c.surface, across, q)).r;
    };
    for (int i = 0; i < kPlaces; ++i) {
      const double begin = own.lo + (own.hi - own.lo) * std::fmod((i + 0.5) * 0.6180339887498949, 1.0), end = begin + (own.hi - own.lo);
      const double across = other.lo + (other.hi - other.lo) * std::fmod(i * 0.7548776662466927 + 0.25, 1.0);
      const Vec3 r = at(begin, across);
      if (!isFinite(r)) continue;
      double apart = norm(at(end, across) - r);
      if (parameters == 2 && !(apart <= kSame * (1e-3 + norm(r))))
        apart = std::fmin(apart, norm(at(end, other.lo + other.hi - across) - r));
      if (apart <= kSame * (1e-3 + norm(r))) continue;
      const char* name = parameters == 1 ? "phi" : k == 0 ? "u" : "v";
      throw FaultError(
          Fault{parameters == 1 ? keyIn(key, "periodic") : keyIn(key, fmt::format("periodic[{}]", k)),
                std::isfinite(apart)
                    ? fmt::format("is true, but r does not repeat itself: its places at {} = {:.6g} and {:.6g} are {:.3g} m apart", name,
                                  begin, end, apart)
                    : fmt::format("is true, but r has a value at {} = {:.6g} and none at {:.6g}", name, begin, end),
                "true for a formula of that period; else false, with at_end stop or bounce"});
    }
  }
}

}  // namespace

std::array<double, kMaxShapeParameters> shapeOf(const Definition& definition, const std::map<std::string, double>& shape,
                                                const std::string& key) {
  std::array<double, kMaxShapeParameters> values{};
  const FormulaText text = formulaOf(definition);
  std::vector<Fault> faults;
  for (const auto& [name, value] : shape) {
    std::size_t i = 0;
    while (i < definition.shape.size() && definition.shape[i].name != name) ++i;
    if (i == definition.shape.size())
      faults.push_back({keyIn(key, "shape." + name.substr(0, 40)),
                        definition.name + " has no such parameter" + didYouMean(name, text.parameters),
                        text.parameters.empty() ? "none" : listOf(text.parameters)});
  }
  for (std::size_t i = 0; i < definition.shape.size() && i < kMaxShapeParameters; ++i) {
    const ShapeParameter& p = definition.shape[i];
    const auto given = shape.find(p.name);
    values[i] = given == shape.end() ? p.defaultValue : given->second;
    NumberRange range{p.min, p.max, true, fmt::format("{} to {}{}", p.min, p.max, p.unit == "1" ? "" : " " + p.unit), p.whole};
    if (p.whole) range.allowed = "a whole number, " + range.allowed;
    checkNumber(keyIn(key, "shape." + p.name), values[i], range, faults);
  }
  if (!faults.empty()) throw FaultError(std::move(faults));
  return values;
}

Constraint makeConstraint(const Definition& definition, const std::map<std::string, double>& shape, const std::string& key) {
  const std::array<double, kMaxShapeParameters> values = shapeOf(definition, shape, key);
  Constraint c = assemble(compileFormula(formulaOf(definition), key), values, generatedFunctions(definition));
  c.name = definition.name;
  c.domain = domainOf(definition, values);
  for (int k = 0; k < c.parameterCount(); ++k)
    if (!(c.domain[k].lo < c.domain[k].hi))
      throw FaultError(Fault{key, fmt::format("has a domain from {} to {} in this shape", c.domain[k].lo, c.domain[k].hi), "lo < hi"});
  requirePeriods(c, key);
  requireUsable(c, boundedDomain(c), false, key);
  return c;
}

namespace {

Constraint make(const ConstraintSpec& spec, const std::string& key) {
  if (spec.curve.empty() && spec.surface.empty()) {
    if (spec.name == "free") {
      if (!spec.shape.empty()) throw FaultError(Fault{keyIn(key, "shape"), "free has no shape", "no shape"});
      Constraint c;
      c.name = "free";
      return c;
    }
    return makeConstraint(spec.definition.empty() ? findDefinition(spec.name, key) : parseDefinition(spec.definition, key), spec.shape,
                          key);
  }
  const std::vector<std::string>& lines = spec.curve.empty() ? spec.surface : spec.curve;
  if (lines.size() != 3) throw FaultError(Fault{key, fmt::format("has {} formulas", lines.size()), "three, one a coordinate"});
  FormulaText text;
  text.kind = spec.curve.empty() ? ConstraintKind::Surface : ConstraintKind::Curve;
  std::copy(lines.begin(), lines.end(), text.coordinates.begin());
  std::array<double, kMaxShapeParameters> values{};
  std::vector<Fault> faults;
  for (const auto& [name, value] : spec.shape) {
    if (text.parameters.size() < kMaxShapeParameters) values[text.parameters.size()] = value;
    text.parameters.push_back(name);
    checkNumber(keyIn(key, "shape." + name), value, anyNumber(), faults);
  }
  if (!faults.empty()) throw FaultError(std::move(faults));
  Constraint c = assemble(compileFormula(text, key), values, {});
  c.name = text.kind == ConstraintKind::Curve ? "curve" : "surface";
  // Without a task nobody knows yet where a mass will be: its start decides.
  if (spec.inUse) requireUsable(c, *spec.inUse, true, key);
  else requireMoving(c, boundedDomain(c), key);
  return c;
}

/// What deeper rooms refuse without knowing where it stands is told under the constraint's key.
template <class Work>
Constraint under(const std::string& key, Work&& work) {
  try {
    return work();
  } catch (const FaultError& error) {
    std::vector<Fault> faults = error.faults;
    for (Fault& fault : faults)
      if (fault.key.empty()) fault.key = key;
    throw FaultError(std::move(faults));
  }
}

}  // namespace

Constraint makeConstraint(const ConstraintSpec& spec, const std::string& key) {
  return under(key, [&] { return make(spec, key); });
}

}  // namespace reachlab::constraints
