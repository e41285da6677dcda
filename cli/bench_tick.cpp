#include "cli/bench_tick.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "constraints/error.h"
#include "sim/bench/scenes.h"
#include "sim/haptics/tick_timing.h"

namespace reachlab {
namespace {

struct Row {
  std::string scene, title, method;
  TickTiming timing;
};

std::vector<bench::BenchScene> chosen(const std::vector<std::string>& names) {
  if (names.empty()) return bench::benchScenes();
  std::vector<bench::BenchScene> scenes;
  for (const std::string& name : names) scenes.push_back(bench::benchScene(name));
  return scenes;
}

void writeRows(const std::string& file, const std::vector<Row>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Row& r : rows)
    all.push_back({{"scene", r.scene}, {"method", r.method}, {"ticks", r.timing.ticks}, {"p50_ns", r.timing.p50}, {"p99_ns", r.timing.p99},
                   {"p99_9_ns", r.timing.p999}, {"max_ns", r.timing.max}, {"clock_ns", r.timing.clock}});
  std::ofstream out(file, std::ios::binary);
  out << all.dump(1) << '\n';
  out.close();
  if (!out) throw ResourceError(file + ": cannot be written");
}

}  // namespace

void runTickBench(const std::vector<std::string>& scenes, std::uint64_t ticks, const std::string& json) {
  std::vector<Row> rows;
  fmt::print("{:<8} {:<10} {:>10} {:>10} {:>10} {:>12}  {}\n", "scene", "method", "p50 [ns]", "p99 [ns]", "p99.9 [ns]", "max [ns]", "what");
  for (const bench::BenchScene& scene : chosen(scenes)) {
    const std::string method = compileScene(scene.experiment).choice.method;
    const TickTiming t = measureTicks(scene.experiment, ticks);
    rows.push_back({scene.name, scene.title, method, t});
    fmt::print("{:<8} {:<10} {:>10.0f} {:>10.0f} {:>10.0f} {:>12.0f}  {}\n", scene.name, method, t.p50, t.p99, t.p999, t.max, scene.title);
    std::fflush(stdout);
  }
  if (!rows.empty())
    fmt::print("{} ticks each; every figure holds one look at the clock, about {:.0f} ns; the largest ones are the operating system's\n", ticks,
               rows.front().timing.clock);
  if (!json.empty()) writeRows(json, rows);
}

}  // namespace reachlab
