#include "sim/haptics/measure_ticks.h"

#include <gtest/gtest.h>

#include "base/system/os.h"
#include "sim/experiment/resources.h"
#include "tests/haptics/armed_at_once.h"

namespace reachlab::haptics {
namespace {

TEST(TickTiming, MeasuresEveryShippedExperiment) {
  for (const std::string& name : experiment::shippedExperiments()) {
    const TickTiming timing = measureTicks(test::armedAtOnce(name), 2000);
    EXPECT_EQ(timing.ticks, 2000u) << name;
    EXPECT_EQ(timing.trials, 1u) << name;
    EXPECT_GT(timing.p50, 0) << name;
    EXPECT_LE(timing.p50, timing.p99) << name;
    EXPECT_GT(timing.middle, timing.p50 / 2) << name;  // from the first quartile to the third, with the median among them
    EXPECT_LE(timing.middle, timing.p99) << name;
    EXPECT_LE(timing.p99, timing.p999) << name;
    EXPECT_LE(timing.p999, timing.max) << name;
  }
}

// Of two ticks the percentiles are the one and the other, and the mean is of both.
TEST(TickTiming, IsRightForAFewTicks) {
  const experiment::Experiment experiment = test::armedAtOnce("dingwell");
  const TickTiming two = measureTicks(experiment, 2);
  EXPECT_EQ(two.ticks, 2u);
  EXPECT_EQ(two.p99, two.max);
  EXPECT_EQ(two.p999, two.max);
  EXPECT_LE(two.p50, two.max);
  EXPECT_EQ(2 * two.middle, two.p50 + two.max);
  for (const std::uint64_t ticks : {0u, 1u}) {
    const TickTiming one = measureTicks(experiment, ticks);
    EXPECT_EQ(one.ticks, 1u);
    EXPECT_EQ(one.p50, one.max);
    EXPECT_EQ(one.middle, one.max);
  }
  const TickTiming four = measureTicks(experiment, 4);  // the middle half are the second, which is the median, and the third
  EXPECT_GE(four.middle, four.p50);
  EXPECT_LE(2 * four.middle, four.p50 + four.max);
  EXPECT_GT(four.clock, 0);
  EXPECT_LT(four.clock, four.max);
}

// All that is measured lies within the time that passes meanwhile.
TEST(TickTiming, TheTicksTakeNoLongerThanTheirMeasurement) {
  const std::int64_t before = os::now();
  const TickTiming timing = measureTicks(test::armedAtOnce("dingwell"), 100);
  const auto passed = static_cast<double>(os::now() - before);
  EXPECT_LT(timing.max, passed);
  EXPECT_LT(50 * timing.middle, passed) << "half of the ticks take their mean each";
  EXPECT_LT(500 * timing.clock, passed) << "half of a thousand looks take no less than their median";
}

std::uint64_t counted = 0;
std::uint64_t countThreeMore() noexcept { return counted += 3; }

TEST(TickTiming, SaysHowManyAllocationsTheTicksMadeWhereTheyAreCounted) {
  counted = 40;
  EXPECT_EQ(measureTicks(test::armedAtOnce("dingwell"), 5, countThreeMore).allocations, 3u) << "from one look to the next";
  EXPECT_EQ(counted, 46u) << "looked at before and after";
  EXPECT_EQ(measureTicks(test::armedAtOnce("dingwell"), 5).allocations, 0u);
}

// 1.35 s and its tolerance go by, and start and target may be one place: the trial goes on.
TEST(TickTiming, OneTrialLastsAsLongAsItIsMeasured) {
  experiment::Experiment experiment = experiment::readExperiment("dingwell");
  EXPECT_EQ(measureTicks(experiment, 4000).trials, 1u);
  experiment.task->target = experiment.task->start;
  EXPECT_EQ(measureTicks(experiment, 4000).trials, 1u);
}

}  // namespace
}  // namespace reachlab::haptics
