#include "cli/terminal/criterion_option.h"

#include <fmt/format.h>

#include "analysis/tables.h"
#include "base/fault.h"

namespace reachlab::cli {

predict::Criterion parseCriterion(const std::string& name) {
  if (const auto criterion = predict::criterionFromName(name)) return *criterion;
  std::string names;
  for (const predict::Criterion c : predict::kAllCriteria) names += (names.empty() ? "" : ", ") + analysis::numberedName(c);
  throw FaultError(Fault{"--criterion", fmt::format("'{}' is not a criterion; allowed, behind the paper's numbers: {}", name, names)});
}

}  // namespace reachlab::cli
