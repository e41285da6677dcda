#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/allocation_count.h"
#include "cli/commands.h"
#include "cli/constraint_bench.h"
#include "base/error.h"
#include "sim/bench/sampled_hand.h"
#include "sim/bench/suite.h"
#include "sim/haptics/tick_timing.h"

namespace reachlab::cli {
namespace {

struct BenchArguments {
  bench::SuiteOptions suite;
  std::string json, svg;
  bool sampled = false, tick = false;
  std::uint64_t ticks = 1'000'000;
};

void showProgress(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

// What a method does not do is said after what the others did.
void showRefusals(const std::vector<std::string>& refusals) {
  if (!refusals.empty()) std::fflush(stdout), showProgress("\nrefused:");
  for (const std::string& refusal : refusals) showProgress("  " + refusal);
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

void writeFile(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw ResourceError(path + ": cannot be written");
}

std::string toJson(const std::vector<bench::Row>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const bench::Row& row : rows) {
    nlohmann::ordered_json o;
    o["scene"] = row.scene;
    o["method"] = row.method;
    o["step_s"] = row.step;
    o["tolerance"] = row.tolerance > 0 ? number(row.tolerance) : nullptr;
    o["state_error"] = number(row.error.state);
    o["position_error_m"] = number(row.error.position);
    o["ns_per_ms"] = row.failure.empty() ? number(row.nsPerMs) : nullptr;
    o["steps"] = row.steps;
    o["rhs_evaluations"] = row.rhsEvaluations;
    all.push_back(std::move(o));
  }
  return all.dump(1) + "\n";
}

std::string toJson(const std::vector<ConstraintEvalRow>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ConstraintEvalRow& row : rows)
    all.push_back({{"constraint", row.constraint}, {"form", row.form}, {"ns_per_eval", number(row.nsPerEval)}});
  return all.dump(1) + "\n";
}

void benchConstraints(const BenchArguments& arguments) {
  const std::vector<ConstraintEvalRow> rows = benchConstraintEval();
  fmt::print("{:<16} {:<14} {:>11}\n", "constraint", "form", "ns_per_eval");
  for (const ConstraintEvalRow& row : rows) fmt::print("{:<16} {:<14} {:>11.1f}\n", row.constraint, row.form, row.nsPerEval);
  if (!arguments.json.empty()) writeFile(arguments.json, toJson(rows));
}

void benchTicks(const BenchArguments& arguments) {
  std::vector<bench::BenchScene> scenes;
  for (const std::string& name : arguments.suite.scenes) scenes.push_back(bench::benchScene(name));
  if (scenes.empty()) scenes = bench::benchScenes();
  fmt::print("{:<7} {:>9} {:>8} {:>8} {:>8} {:>10} {:>9} {:>12}   ns, wall clock\n", "scene", "ticks", "p50", "p99", "p99.9", "max",
             "clock", "allocations");
  std::vector<std::string> refusals;
  for (const bench::BenchScene& scene : scenes) {
    showProgress(scene.name + ": " + scene.title);
    try {
      const haptics::TickTiming t = haptics::measureTicks(scene.experiment, arguments.ticks, countAllocations);
      fmt::print("{:<7} {:>9} {:>8.0f} {:>8.0f} {:>8.0f} {:>10.0f} {:>9.0f} {:>12}\n", scene.name, t.ticks, t.p50, t.p99, t.p999, t.max,
                 t.clock, t.allocations);
    } catch (const Error& e) {
      refusals.push_back(scene.name + ": " + e.what());
    }
  }
  showRefusals(refusals);
}

void runBench(const BenchArguments& arguments) {
  const auto& scenes = arguments.suite.scenes;
  if (std::find(scenes.begin(), scenes.end(), "constraint-eval") != scenes.end()) {
    if (scenes.size() > 1) throw UsageError("bench: --scene constraint-eval stands alone; run the other scenes by themselves");
    benchConstraints(arguments);
    return;
  }
  if (arguments.tick) {
    benchTicks(arguments);
    return;
  }
  if (arguments.sampled) {
    std::fputs(bench::formatSampledHand(bench::measureSampledHand(showProgress)).c_str(), stdout);
    return;
  }
  std::vector<std::string> refusals;
  const std::vector<bench::Row> rows = bench::runSuite(arguments.suite, showProgress, refusals);
  std::fputs(bench::formatTable(rows).c_str(), stdout);
  bool peers = false;
  for (const bench::Row& row : rows) peers |= bench::isPeer(row);
  if (peers) std::fputs(("\n" + bench::formatRatios(rows)).c_str(), stdout);
  showRefusals(refusals);
  if (!arguments.json.empty()) writeFile(arguments.json, toJson(rows));
  if (!arguments.svg.empty()) writeFile(arguments.svg, bench::drawWorkPrecision(rows));
}

}  // namespace

void addBenchCommand(CLI::App& app, int&) {
  auto arguments = std::make_shared<BenchArguments>();
  CLI::App* command =
      app.add_subcommand("bench", "Sets speed against error: scenes S1 to S8, every method, against references of over 20 digits");
  command->add_option("--scene", arguments->suite.scenes,
                      "Scenes (S1 S1b50 S1b500 S2a S2b S3 S4 S5 S5h S6 S7a S7b S7c S7d S7e S8), or constraint-eval for the price of a "
                      "constraint's derivatives; default all");
  command->add_option("--method", arguments->suite.methods, "Methods (auto rk4 exact abm adaptive stiff, or a peer if built); default all");
  command->add_option("--rounds", arguments->suite.effort.rounds, "Timed repetitions, interleaved over the methods")
      ->check(CLI::Range(5, 1000))
      ->capture_default_str();
  command->add_flag("--quick", arguments->suite.quick, "1 ms and the default tolerance only, no peers unless named");
  command->add_flag("--sampled", arguments->sampled,
                    "Instead: what a hand costs that comes as samples at 1 kHz, clean, noisy and quantised");
  command->add_flag("--tick", arguments->tick,
                    "Instead: what a tick costs from the device's sample to the force, without the device, as percentiles");
  command->add_option("--ticks", arguments->ticks, "Ticks of each scene for --tick")
      ->check(CLI::Range(1000, 100'000'000))
      ->capture_default_str();
  command->add_option("--json", arguments->json, "Write the rows to this file");
  command->add_option("--svg", arguments->svg, "Draw price against error into this file");
  command->footer(
      "Prices are nanoseconds of processor time per simulated millisecond (median of the rounds, quartiles beside it); errors are the\n"
      "largest over samples at 100 Hz, in SI units. Compare prices within one run only.\n"
      "Examples: reach bench --scene S1 --scene S2a --quick\n"
      "          reach bench --json rows.json --svg work-precision.svg\n"
      "          reach bench --tick --scene S1 --ticks 100000\n"
      "          reach bench --scene constraint-eval");
  command->callback([arguments] { runBench(*arguments); });
}

}  // namespace reachlab::cli
