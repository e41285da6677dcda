#include "cli/terminal/criterion_option.h"

#include <fmt/format.h>

#include "analysis/tables.h"
#include "base/fault.h"

namespace reachlab::cli {

predict::Criterion parseCriterion(const std::string& name) {
  if (const auto criterion = predict::criterionFromName(name)) return *criterion;
  std::string names;
  for (int i = 0; i < predict::kCriterionCount; ++i) names += (i ? ", " : "") + analysis::numberedName(static_cast<predict::Criterion>(i));
  throw FaultError(Fault{"--criterion", fmt::format("'{}' is not a criterion; allowed, behind the paper's numbers: {}", name, names)});
}

}  // namespace reachlab::cli
