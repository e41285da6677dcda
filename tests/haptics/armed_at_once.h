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

}  // namespace reachlab::haptics::test
