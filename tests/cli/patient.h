#pragma once
#include "sim/experiment/experiment.h"
#include "tests/cli/program.h"

namespace reachlab::test {

/// A file with a shipped experiment that bears missed time: what is shown of devices does not hang on how busy the machine is.
inline std::string patient(const Folder& folder, const std::string& name) {
  experiment::Experiment lenient = experiment::readExperiment(name);
  lenient.timing = experiment::kNoTimingLimits;
  return folder.write(name + ".json", toJson(lenient));
}

}  // namespace reachlab::test
