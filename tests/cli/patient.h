#pragma once
#include "sim/experiment/experiment.h"
#include "tests/cli/program.h"

namespace reachlab::test {

/// A file with a shipped experiment that bears missed time: what is shown of devices does not hang on how busy the machine is.
inline std::string patient(const TemporaryFolder& folder, const std::string& name) {
  experiment::Experiment lenient = experiment::readExperiment(name);
  lenient.timing = experiment::kNoTimingLimits;
  return folder.write(name + ".json", toJson(lenient));
}

/// Whether the machine stood still for so long that the watch over devices gave the run up, as it must; a stand-in that moves in real time is
/// then far away, too.
inline bool isDisturbed(const Ended& run) {
  for (const char* fault : {"(fault: stalled)", "(fault: silent)", "(fault: jump)", "(fault: speed)"})
    if (run.err.find(fault) != std::string::npos) return true;
  return false;
}

/// Made again, at most three times, when it was disturbed.
inline Ended reachUndisturbed(const std::string& arguments, const std::string& environment) {
  Ended run = reach(arguments, environment);
  for (int again = 0; again < 3 && isDisturbed(run); ++again) run = reach(arguments, environment);
  return run;
}

}  // namespace reachlab::test
