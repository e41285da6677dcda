#include "sim/session/planned_trials.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/math/seeded.h"
#include "base/ticks.h"
#include "sim/session/mix/mix_order.h"

namespace reachlab::session {
namespace {

constexpr std::uint64_t kForeperiodStream = 0x666f7265,
                        kCatchStream = 0x63617463;  // so that the two draws have nothing to do with each other

// Scenes are numbered as scenesOf numbers them.
std::vector<trial::PlannedTrial> inTheirScenes(const PlanBlock& block, std::uint64_t seed) {
  if (block.mix.isPlain()) return std::vector<trial::PlannedTrial>(static_cast<std::size_t>(block.trials));
  std::vector<trial::PlannedTrial> trials;
  for (const MixedTrial& one : orderTrials(block.mix, block.trials, seed)) {
    const int place = one.kind * block.mix.targetCount() + one.target;
    if (!block.mix.wayBack) {
      trials.push_back({.scene = place});
      continue;
    }
    trials.push_back({.scene = 2 * place});
    trials.push_back({.scene = 2 * place + 1});
  }
  return trials;
}

}  // namespace

std::vector<trial::PlannedTrial> planTrials(const PlanBlock& block, std::uint64_t seed) {
  std::vector<trial::PlannedTrial> trials = inTheirScenes(block, seed);
  const std::size_t count = trials.size();
  const double lo = block.foreperiodMin, hi = block.foreperiodMax;
  for (std::size_t i = 0; i < count; ++i) {
    trials[i].index = static_cast<int>(i);
    const double foreperiod = lo + (hi - lo) * seededFraction(seed ^ kForeperiodStream, i);
    trials[i].foreperiodTicks = static_cast<int>(std::lround(foreperiod * kTicksPerSecond));
  }
  // The catch trials are those with the smallest drawn numbers; the first trial is never one, nobody would know what to do.
  std::vector<std::size_t> byDraw(count > 0 ? count - 1 : 0);
  std::iota(byDraw.begin(), byDraw.end(), std::size_t{1});
  std::sort(byDraw.begin(), byDraw.end(),
            [&](std::size_t a, std::size_t b) { return seededBits(seed ^ kCatchStream, a) < seededBits(seed ^ kCatchStream, b); });
  const auto catches = static_cast<std::size_t>(std::lround(block.catchShare * static_cast<double>(count)));
  for (std::size_t k = 0; k < std::min(catches, byDraw.size()); ++k) trials[byDraw[k]].catchTrial = true;
  return trials;
}

std::uint64_t blockSeed(std::uint64_t seed, int block) { return block == 1 ? seed : seededBits(seed, static_cast<std::uint64_t>(block)); }

}  // namespace reachlab::session
