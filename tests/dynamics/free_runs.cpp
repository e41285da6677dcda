// Prints the table of docs/energy-drift.md: one seeded free run on every definition of the catalogue. `free_runs [SEED]`
#include <fmt/format.h>

#include <cstdlib>

#include "tests/dynamics/free_run.h"

namespace reachlab {
namespace {

std::string numbers(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", value);
  return text;
}

std::string outcome(const FreeRun& run) {
  if (run.status == StepStatus::Ok) return fmt::format("10 | {:.1e}", run.drift);
  const char* why = run.status == StepStatus::AtEnd            ? "end"
                    : run.status == StepStatus::NoContinuation ? "degenerate"
                                                               : describe(run.status).data();
  return fmt::format("{:.3f} {} | {:.1e}", run.seconds, why, run.drift);
}

void printTable(std::uint64_t seed) {
  fmt::print("| definition | from | rate [1/s] | as shipped [s] | drift | elastic ends [s] | drift |\n|---|---|---|---|---|---|---|\n");
  for (const Definition& definition : catalogue()) {
    const FreeRun shipped = runFree(definition, seed, false);
    const std::string elastic = shipped.status == StepStatus::AtEnd ? outcome(runFree(definition, seed, true)) : "|";
    fmt::print("| {} | {} | {} | {} | {} |\n", definition.name, numbers(shipped.start), numbers(shipped.rate), outcome(shipped), elastic);
  }
}

}  // namespace
}  // namespace reachlab

int main(int argc, char** argv) { reachlab::printTable(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1); }
