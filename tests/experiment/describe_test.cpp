#include "sim/experiment/describe.h"

#include <gtest/gtest.h>

#include "sim/experiment/compiled_experiment.h"

namespace reachlab::experiment {
namespace {

// 1.5 s, give or take 8.5 s, asks for no pace.
TEST(Describe, AToleranceLongerThanTheReachIsToldAsALimit) {
  Experiment torus = openExperiment("torus").experiment();
  EXPECT_NE(describe(torus).find("1.5 ± 0.6 s"), std::string::npos) << describe(torus);
  torus.task->tolerance.time = 8.5;
  EXPECT_NE(describe(torus).find("within 10 s"), std::string::npos) << describe(torus);
}

TEST(ShippedExperiments, TeachTiming) {
  for (const std::string& name : shippedExperiments()) {
    const Task task = *openExperiment(name).experiment().task;
    EXPECT_GT(task.duration - task.tolerance.time, 0.1) << name << ": the lamp would be green from the onset";
  }
}

}  // namespace
}  // namespace reachlab::experiment
