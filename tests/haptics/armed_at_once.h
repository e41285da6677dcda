#pragma once
#include <string>

#include "sim/experiment/experiment.h"

namespace reachlab::haptics::test {

/// A shipped experiment whose trials are armed on touching the start: what a test of something else waits for.
inline experiment::Experiment armedAtOnce(const std::string& name) {
  experiment::Experiment experiment = experiment::readExperiment(name);
  experiment.task->rest = experiment::kNoStartRest;
  return experiment;
}

/// The same with movements that may have gaps, so that a machine that misses time spoils nothing, and what a gap does is seen to its end.
inline experiment::Experiment armedPatiently(const std::string& name) {
  experiment::Experiment experiment = armedAtOnce(name);
  experiment.timing = experiment::kNoTimingLimits;
  return experiment;
}

}  // namespace reachlab::haptics::test
