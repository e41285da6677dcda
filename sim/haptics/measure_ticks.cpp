#include "sim/haptics/measure_ticks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/system/os.h"
#include "sim/haptics/tick_order.h"
#include "base/ticks.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/task_plane.h"

namespace reachlab::haptics {
namespace {

constexpr std::uint32_t kRowTicks = 10;  // a row of the recording every so many ticks, as by default

experiment::Experiment withoutEnd(experiment::Experiment experiment) {
  if (!experiment.task) return experiment;
  experiment.task->duration = experiment::kMaxDuration;  // the longest that is allowed: a trial that does end is put up again
  experiment.task->rest = experiment::kNoStartRest;      // its hand never rests
  // Where start and target are one place, an object that has not gone far would have arrived.
  experiment.task->tolerance.position = experiment.task->tolerance.velocity = std::numeric_limits<double>::min();
  return experiment;
}

double percentile(std::vector<std::int64_t>& sorted, double share) {
  const auto at = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size()))) - 1;
  return static_cast<double>(sorted[std::min(at, sorted.size() - 1)]);
}

double meanOfMiddleHalf(const std::vector<std::int64_t>& sorted) {
  const auto quarter = static_cast<std::ptrdiff_t>(sorted.size() / 4);
  const std::int64_t sum = std::accumulate(sorted.begin() + quarter, sorted.end() - quarter, std::int64_t{0});
  return static_cast<double>(sum) / static_cast<double>(std::ssize(sorted) - 2 * quarter);
}

}  // namespace

TickTiming measureTicks(const experiment::Experiment& experiment, std::uint64_t ticks, std::uint64_t (*countAllocations)() noexcept) {
  TickEngine engine(withoutEnd(experiment), {});
  engine.setMassesEvery(kRowTicks);
  const Vec3 start = engine.protocol().start, chord = engine.protocol().target - start;
  constexpr double kShare = 0.1, kLeast = 0.01, kAside = 0.1, kOmega = 2 * std::numbers::pi;
  const Vec3 along = norm(chord) > 0 ? kShare * chord : Vec3{kLeast, 0, 0};
  // A little aside, so that the wall of a channel pushes.
  const Vec3 swing = along + kAside * norm(along) * experiment::rightOf(along, experiment::normalOf(experiment::TaskPlane::Horizontal));

  std::vector<std::int64_t> costs(std::max<std::uint64_t>(ticks, 1)), looks(1001);
  for (auto& look : looks) {
    const std::int64_t before = os::now();
    look = os::now() - before;
  }
  TickInput input;
  std::uint64_t trials = 0;
  std::uint64_t since = 0;  // ticks of this trial; a trial that ends all the same (an edge was met) is put up again
  const std::uint64_t allocatedBefore = countAllocations ? countAllocations() : 0;
  for (auto& cost : costs) {
    const trial::Phase phase = engine.state().phase;
    const bool over = phase == trial::Phase::Idle || phase == trial::Phase::Done;
    trials += over;
    input.command = over ? trial::Command::NextTrial : trial::Command::None;
    since = over || phase == trial::Phase::Waiting ? 0 : since + 1;
    input.devices[0].position = start + std::sin(kOmega * kTickSeconds * static_cast<double>(since)) * swing;
    const std::int64_t before = os::now();
    runTick(engine, input);
    cost = os::now() - before;
  }
  const std::uint64_t allocated = countAllocations ? countAllocations() - allocatedBefore : 0;
  std::sort(costs.begin(), costs.end());
  std::sort(looks.begin(), looks.end());
  return {costs.size(),
          trials,
          percentile(costs, 0.5),
          percentile(costs, 0.99),
          percentile(costs, 0.999),
          static_cast<double>(costs.back()),
          meanOfMiddleHalf(costs),
          static_cast<double>(looks[looks.size() / 2]),
          allocated};
}

}  // namespace reachlab::haptics
