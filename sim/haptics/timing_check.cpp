#include "sim/haptics/timing_check.h"

#include <fmt/format.h>

#include <algorithm>

namespace reachlab::haptics {
namespace {

constexpr double kMicroseconds = 1e-6, kTickMs = 1;

double longestGapMs(const LoopReport& report) {
  const double counted = static_cast<double>(report.faults.longestGapNs) * kMicroseconds;
  return std::max(counted, kTickMs + report.latenessMax * 1e-3);  // a gap of less than two ticks is not counted as one
}

}  // namespace

TimingVerdict judgeTiming(const LoopReport& report, const trial::ProtocolSettings& limits) {
  TimingVerdict verdict;
  verdict.realTime = report.realTime;
  const auto missed = static_cast<std::int64_t>(report.faults.missedTicks);
  const auto gapTicks = static_cast<std::int64_t>(report.faults.longestGapNs) / LoopCore::kPeriodNs;
  verdict.good = report.ticks > 0 && missed <= limits.maxMissedTicks && gapTicks <= limits.maxGapTicks;
  verdict.sentence =
      fmt::format("timing {}: in {:.2f} s {} of {} ticks missed, longest gap {:.2f} ms", verdict.good ? "good" : "not good enough",
                  report.seconds, missed, missed + static_cast<std::int64_t>(report.ticks), longestGapMs(report));
  if (!verdict.good)
    verdict.sentence +=
        fmt::format("; a movement that misses more than {} ticks, or has a gap above {} ms, does not count: end other programs",
                    limits.maxMissedTicks, limits.maxGapTicks);
  if (!verdict.realTime) verdict.sentence += fmt::format("; {}: the page Timing (docs/timing.md) says how to get it", report.mode);
  return verdict;
}

}  // namespace reachlab::haptics
