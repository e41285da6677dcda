#include "cli/output/trial_line.h"

#include <fmt/format.h>

#include "sim/record/export/tidy_csv.h"

namespace reachlab::cli {

std::string trialLine(int trial, const trial::TrialResult& result, const record::RunScene* scene) {
  std::string line = fmt::format("trial={}", trial);
  if (scene != nullptr && !scene->kind.empty()) line += " kind=" + scene->kind;
  if (scene != nullptr && !scene->target.empty()) line += " target=" + scene->target;
  line += fmt::format(" outcome={}", trial::nameOf(result.outcome));
  if (result.outcome != trial::Outcome::Success) line += fmt::format(" reason={}", trial::nameOf(result.reason));
  if (result.mass > 0) line += fmt::format(" mass={}", result.mass);
  // For a person; the log and the exports have every digit.
  if (result.by != 0) line += fmt::format(" by={:.3g}", result.by);
  if (const std::string unit = record::unitOf(result.reason); result.by != 0 && !unit.empty()) line += " by_unit=" + unit;
  return line + fmt::format(" time_s={:.3f}", result.movementTime);
}

}  // namespace reachlab::cli
