#include "sim/session/trial_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/math/seeded.h"
#include "base/ticks.h"

namespace reachlab::session {
namespace {

constexpr std::uint64_t kForeperiodStream = 0x666f7265,
                        kCatchStream = 0x63617463;  // so that the two draws have nothing to do with each other

}  // namespace

std::vector<trial::PlannedTrial> planTrials(const PlanBlock& block, std::uint64_t seed) {
  const auto count = static_cast<std::size_t>(block.trials);
  std::vector<trial::PlannedTrial> trials(count);
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
