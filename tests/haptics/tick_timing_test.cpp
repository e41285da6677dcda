#include "sim/haptics/tick_timing.h"

#include <gtest/gtest.h>

#include "base/fault.h"
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

TEST(TickTiming, RefusesAnExperimentWithoutATask) {
  experiment::Experiment experiment = test::armedAtOnce("dingwell");
  experiment.task.reset();
  EXPECT_THROW(measureTicks(experiment, 10), FaultError);
}

}  // namespace
}  // namespace reachlab::haptics
