#include "cli/criterion_option.h"

#include <fmt/format.h>

#include "constraints/error.h"
#include "sim/analyze/tables.h"

namespace reachlab {

Criterion parseCriterion(const std::string& name) {
  if (const auto criterion = criterionFromName(name)) return *criterion;
  std::string names;
  for (int i = 0; i < kCriterionCount; ++i) names += (i ? ", " : "") + numberedName(static_cast<Criterion>(i));
  throw UsageError(fmt::format("--criterion: '{}' is not a criterion; allowed, behind the paper's numbers: {}", name, names));
}

}  // namespace reachlab
