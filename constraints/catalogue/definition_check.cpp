#include <fmt/format.h>

#include <algorithm>

#include "base/fault.h"
#include "constraints/catalogue/definition.h"

namespace reachlab::constraints {
namespace {

bool isDefinitionName(const std::string& name) {
  return !name.empty() && name.size() <= 60 && name != "free" && name.front() != '-' &&
         std::all_of(name.begin(), name.end(), [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
}

void checkPlace(const std::string& key, const std::vector<double>& place, const std::array<Domain, 2>& domain, std::size_t dimensions,
                std::vector<Fault>& faults) {
  if (place.size() != dimensions) return faults.push_back({key, "is no place", dimensions == 1 ? "[phi]" : "[u, v]"});
  for (std::size_t k = 0; k < dimensions; ++k)
    if (!domain[k].has(place[k]))
      faults.push_back(
          {fmt::format("{}[{}]", key, k), fmt::format("is {}", place[k]), fmt::format("{} to {}", domain[k].lo, domain[k].hi)});
}

}  // namespace

std::array<double, kMaxShapeParameters> defaultsOf(const Definition& definition) {
  std::array<double, kMaxShapeParameters> defaults{};
  for (std::size_t i = 0; i < std::min<std::size_t>(definition.shape.size(), kMaxShapeParameters); ++i)
    defaults[i] = definition.shape[i].defaultValue;
  return defaults;
}

std::vector<Fault> problems(const Definition& definition) {
  std::vector<Fault> faults;
  if (!isDefinitionName(definition.name))
    faults.push_back({"name", "is no name of a definition", "lower-case letters, digits and '-', at most 60, not free"});
  for (const ShapeParameter& p : definition.shape)
    if (!(p.min <= p.defaultValue && p.defaultValue <= p.max))
      faults.push_back({"shape." + p.name, fmt::format("default {} is not within min {} and max {}", p.defaultValue, p.min, p.max),
                        "min <= default <= max"});
  const std::size_t before = faults.size();
  for (const FormulaFault& fault : formulaFaults(formulaOf(definition))) faults.push_back(toFault(fault, definition.kind, ""));
  if (faults.size() > before) return faults;  // what follows is computed with the shape's names
  const std::size_t dimensions = definition.kind == ConstraintKind::Curve ? 1 : 2;
  std::array<Domain, 2> domain;
  try {
    domain = domainOf(definition, defaultsOf(definition));
  } catch (const FaultError& error) {
    faults.insert(faults.end(), error.faults.begin(), error.faults.end());
    return faults;
  }
  for (std::size_t k = 0; k < dimensions; ++k) {
    const std::string key = dimensions == 1 ? "domain" : fmt::format("domain[{}]", k);
    if (!(domain[k].lo < domain[k].hi)) faults.push_back({key, fmt::format("runs from {} to {}", domain[k].lo, domain[k].hi), "lo < hi"});
    if (domain[k].periodic && (definition.domain[k].lo.empty() || definition.domain[k].hi.empty()))
      faults.push_back(
          {dimensions == 1 ? "periodic" : fmt::format("periodic[{}]", k), "is true without a range", "a domain with two ends"});
  }
  checkPlace("start", definition.start, domain, dimensions, faults);
  checkPlace("target", definition.target, domain, dimensions, faults);
  return faults;
}

}  // namespace reachlab::constraints
