#include "bench/measure.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/system/os.h"
#include "base/ticks.h"

namespace reachlab::bench {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double largestDifference(const std::vector<double>& a, const std::vector<Quad>& b) {
  if (a.size() != b.size()) return kNan;
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = static_cast<double>(absolute(Quad(a[i] - b[i])));
    if (!std::isfinite(d)) return kNan;
    worst = std::max(worst, d);
  }
  return worst;
}

std::uint64_t hashOf(const std::vector<double>& numbers) {  // FNV-1a, number by number
  std::uint64_t hash = 14695981039346656037u;
  for (const double number : numbers) hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 1099511628211u;
  return hash;
}

double quantile(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double at = p * static_cast<double>(values.size() - 1);
  const std::size_t i = static_cast<std::size_t>(at);
  const double f = at - static_cast<double>(i);
  return i + 1 < values.size() ? values[i] * (1 - f) + values[i + 1] * f : values[i];
}

}  // namespace

Deviation computeError(const Trajectory& trajectory, const Reference& reference) {
  if (!trajectory.failure.empty()) return {kNan, kNan};
  return {largestDifference(trajectory.states, reference.states), largestDifference(trajectory.positions, reference.positions)};
}

std::vector<Row> measure(const BenchScene& scene, const Reference& reference, const std::vector<Contender>& contenders,
                         const Effort& effort) {
  const double ticks = std::round(scene.duration / kTickSeconds);
  std::vector<Row> rows;
  std::vector<int> repeats;
  std::vector<std::vector<double>> times(contenders.size());
  for (const Contender& c : contenders) {
    Trajectory trajectory;
    c.run(&trajectory);
    Row row;
    row.scene = scene.name, row.method = c.method, row.form = c.form, row.step = c.step, row.tolerance = c.tolerance;
    row.error = computeError(trajectory, reference);
    row.steps = trajectory.steps, row.rhsEvaluations = trajectory.rhsEvaluations, row.worstTick = trajectory.worstTick;
    row.failure = trajectory.failure;
    row.bits = hashOf(trajectory.states);
    rows.push_back(row);
    // The first timed run warms the caches and says how often a round repeats.
    const std::int64_t start = os::threadProcessorTime();
    c.run(nullptr);
    const double once = std::max(1.0, static_cast<double>(os::threadProcessorTime() - start)) * 1e-9;
    repeats.push_back(std::clamp(static_cast<int>(std::ceil(effort.secondsPerRound / once)), 1, 10'000));
  }
  for (int round = 0; round < effort.rounds; ++round)
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      if (!rows[i].failure.empty()) continue;  // the price of half a reach says nothing
      const std::int64_t start = os::threadProcessorTime();
      for (int r = 0; r < repeats[i]; ++r) contenders[i].run(nullptr);
      times[i].push_back(static_cast<double>(os::threadProcessorTime() - start) / repeats[i] / ticks);
    }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (times[i].empty()) continue;
    rows[i].nsPerMs = quantile(times[i], 0.5), rows[i].nsLow = quantile(times[i], 0.25), rows[i].nsHigh = quantile(times[i], 0.75);
  }
  return rows;
}

}  // namespace reachlab::bench
