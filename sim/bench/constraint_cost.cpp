#include "sim/bench/constraint_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "constraints/definition.h"
#include "sim/bench/measure.h"

namespace reachlab::bench {
namespace {

constexpr int kPlaces = 256, kRounds = 7, kRepeats = 40;

// Places between a fifth and four fifths of the domain, which no definition ends in.
double placeIn(const Domain& domain, int i) {
  const double lo = std::isfinite(domain.lo) ? domain.lo : -1, hi = std::isfinite(domain.hi) ? domain.hi : 1;
  return lo + (hi - lo) * (0.2 + 0.6 * i / kPlaces);
}

double nsPerEvaluation(const Constraint& constraint) {
  std::array<double, kPlaces> u, v;
  for (int i = 0; i < kPlaces; ++i) u[i] = placeIn(constraint.domain[0], i), v[i] = placeIn(constraint.domain[1], (i * 37) % kPlaces);
  std::array<double, kRounds> times;
  for (double& time : times) {
    double sum = 0;
    const std::int64_t start = threadTimeNs();
    for (int repeat = 0; repeat < kRepeats; ++repeat)
      for (int i = 0; i < kPlaces; ++i)
        sum += constraint.kind == ConstraintKind::Curve ? evaluate(constraint.curve, u[i]).rPhiPhi.x : evaluate(constraint.surface, u[i], v[i]).rVv.x;
    time = static_cast<double>(threadTimeNs() - start) / (kRepeats * kPlaces);
    consume(sum);
  }
  std::sort(times.begin(), times.end());
  return times[kRounds / 2];
}

}  // namespace

std::vector<ConstraintCost> measureConstraintCosts() {
  std::vector<ConstraintCost> rows;
  for (const Definition& definition : catalogue()) {
    rows.push_back({definition.name, "generated", nsPerEvaluation(makeConstraint(definition))});
    ConstraintSpec typed;
    typed.name.clear();
    const std::vector<std::string> text(definition.coordinates.begin(), definition.coordinates.end());
    (definition.kind == ConstraintKind::Curve ? typed.curve : typed.surface) = text;
    for (const ShapeParameter& parameter : definition.shape) typed.shape[parameter.name] = parameter.defaultValue;
    Constraint constraint = makeConstraint(typed);
    constraint.domain = makeConstraint(definition).domain;
    rows.push_back({definition.name, "typed", nsPerEvaluation(constraint)});
  }
  return rows;
}

std::string formatConstraintCosts(const std::vector<ConstraintCost>& rows) {
  std::string out = fmt::format("{:<24} {:<10} {:>11}\n", "constraint", "form", "ns_per_eval");
  for (const ConstraintCost& row : rows) out += fmt::format("{:<24} {:<10} {:>11.1f}\n", row.constraint, row.form, row.nsPerEval);
  return out;
}

}  // namespace reachlab::bench
