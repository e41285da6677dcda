#include <gtest/gtest.h>

#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"

namespace reachlab::experiment {
namespace {

TEST(ShippedExperiments, TeachTiming) {
  for (const std::string& name : shippedExperiments()) {
    const Task task = *openExperiment(name).experiment().task;
    EXPECT_GT(task.duration - task.tolerance.time, 0.1) << name << ": the lamp would be green from the onset";
  }
}

}  // namespace
}  // namespace reachlab::experiment
