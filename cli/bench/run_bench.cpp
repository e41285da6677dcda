#include "cli/bench/bench_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/processor_level.h"
#include "cli/bench/allocation_count.h"
#include "cli/bench/constraint_bench.h"
#include "network/link_check/link_bench.h"
#include "bench/sampled_hand.h"
#include "bench/report.h"
#include "bench/suite.h"
#include "sim/experiment/describe.h"
#include "sim/haptics/measure_ticks.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::cli {
namespace {

void showProgress(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

// What a method does not do is said after what the others did.
void showRefusals(const std::vector<std::string>& refusals) {
  if (!refusals.empty()) std::fflush(stdout), showProgress("\nrefused:");
  for (const std::string& refusal : refusals) showProgress("  " + refusal);
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::string toJson(const std::vector<bench::Row>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const bench::Row& row : rows) {
    nlohmann::ordered_json o = nlohmann::ordered_json::object();
    o["level"] = processorLevel();
    o["scene"] = row.scene;
    o["method"] = row.method;
    o["step_s"] = row.step;
    o["tolerance"] = row.tolerance > 0 ? number(row.tolerance) : nullptr;
    o["state_error"] = number(row.error.state);
    o["position_error_m"] = number(row.error.position);
    o["ns_per_ms"] = row.failure.empty() ? number(row.nsPerMs) : nullptr;
    o["steps"] = row.steps;
    o["rhs_evaluations"] = row.rhsEvaluations;
    o["bits"] = fmt::format("{:016x}", row.bits);
    all.push_back(std::move(o));
  }
  return all.dump(1) + "\n";
}

std::string toJson(const std::vector<ConstraintEvalRow>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const ConstraintEvalRow& row : rows)
    all.push_back(
        {{"constraint", row.constraint}, {"form", row.form}, {"ns_per_eval", number(row.nsPerEval)}, {"apart_m", number(row.apart)}});
  return all.dump(1) + "\n";
}

void benchConstraints(const BenchOptions& options) {
  const std::vector<ConstraintEvalRow> rows = benchConstraintEval();
  fmt::print("{:<16} {:<14} {:>11} {:>8}\n", "constraint", "form", "ns_per_eval", "apart_m");
  for (const ConstraintEvalRow& row : rows)
    fmt::print("{:<16} {:<14} {:>11.1f} {:>8.1e}\n", row.constraint, row.form, row.nsPerEval, row.apart);
  if (!options.json.empty()) record::writeFileAtomically(options.json, toJson(rows));
}

/// A scene of the table, or any experiment.
bench::BenchScene tickScene(const std::string& name) {
  for (bench::BenchScene& scene : bench::benchScenes())
    if (scene.name == name) return std::move(scene);
  experiment::Experiment experiment = experiment::readExperiment(name);
  return {.name = experiment.name,
          .title = experiment::describe(experiment),
          .experiment = std::move(experiment),
          .hand = {},
          .start = {},
          .rate = {}};
}

void benchTicks(const BenchOptions& options) {
  std::vector<bench::BenchScene> scenes;
  for (const std::string& name : options.scenes) scenes.push_back(tickScene(name));
  if (scenes.empty()) scenes = bench::benchScenes();
  fmt::print("{:<7} {:>9} {:>7} {:>8} {:>10} {:>8} {:>8} {:>10} {:>9} {:>12}   ns, wall clock; middle: mean of the middle half\n", "scene",
             "ticks", "trials", "p50", "middle", "p99", "p99.9", "max", "clock", "allocations");
  std::vector<std::string> refusals;
  for (const bench::BenchScene& scene : scenes) {
    showProgress(scene.name + ": " + scene.title);
    try {
      const haptics::TickTiming t = haptics::measureTicks(scene.experiment, options.ticks, countAllocations);
      fmt::print("{:<7} {:>9} {:>7} {:>8.0f} {:>10.2f} {:>8.0f} {:>8.0f} {:>10.0f} {:>9.0f} {:>12}\n", scene.name, t.ticks, t.trials, t.p50,
                 t.middle, t.p99, t.p999, t.max, t.clock, t.allocations);
    } catch (const Error& e) {
      refusals.push_back(scene.name + ": " + e.what());
    }
  }
  showRefusals(refusals);
}

void benchNetwork(const BenchOptions& options) {
  network::LinkBenchPlan plan;
  plan.setups = options.setups;
  if (options.quick) {
    plan.roundTrips = {0, 0.05, 0.1};
    plan.seeds = 2;
    plan.setups = 0;
  }
  for (const std::string& name : options.methods)
    if (name != "design")
      throw FaultError(Fault{"method", fmt::format("is \"{}\"", name), "design with --network: the coupling that stations have"});
  const network::LinkBenchTables tables = network::runLinkBench(plan, showProgress);
  std::fputs(network::formatLinkBench(tables).c_str(), stdout);
  if (!options.csv.empty()) record::writeFileAtomically(options.csv, network::linkBenchCsv(tables));
  if (!options.svg.empty()) record::writeFileAtomically(options.svg, network::drawLinkBench(tables));
}

void benchMethods(const BenchOptions& options) {
  bench::SuiteOptions suite{.scenes = options.scenes, .methods = options.methods, .effort = {}, .quick = options.quick};
  suite.effort.rounds = options.rounds;
  std::vector<std::string> refusals;
  const std::vector<bench::Row> rows = bench::runSuite(suite, showProgress, refusals);
  std::fputs(bench::formatTable(rows).c_str(), stdout);
  bool peers = false;
  for (const bench::Row& row : rows) peers |= bench::isPeer(row);
  if (peers) std::fputs(("\n" + bench::formatRatios(rows)).c_str(), stdout);
  showRefusals(refusals);
  if (!options.json.empty()) record::writeFileAtomically(options.json, toJson(rows));
  if (!options.svg.empty()) record::writeFileAtomically(options.svg, bench::drawWorkPrecision(rows));
}

}  // namespace

void runBench(const BenchOptions& options) {
  const auto& scenes = options.scenes;
  fmt::print("level {}\n", processorLevel());
  if (std::find(scenes.begin(), scenes.end(), "constraint-eval") != scenes.end()) {
    if (scenes.size() > 1)
      throw FaultError(Fault{"--scene", "constraint-eval cannot be combined with other scenes; run the other scenes by themselves"});
    benchConstraints(options);
  } else if (options.network) {
    benchNetwork(options);
  } else if (options.tick) {
    benchTicks(options);
  } else if (options.sampled) {
    std::fputs(bench::formatSampledHand(bench::measureSampledHand(showProgress)).c_str(), stdout);
  } else {
    benchMethods(options);
  }
}

}  // namespace reachlab::cli
