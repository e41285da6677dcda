#pragma once
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "constraints/constraint.h"
#include "devices/make_device.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/run_conductor.h"
#include "sim/record/export/bids.h"
#include "sim/record/log/recorder.h"
#include "sim/session/session_folder.h"
#include "tests/analysis/whole_dataset.h"
#include "tests/in_a_folder.h"

/// Datasets made the way a session makes them: experiment, device, engine, recorder, on the virtual clock.
namespace reachlab::analysis {

struct RunToRecord {
  std::string experiment = "chain-moderate", device = "simulated", subject = "01", session = "01";
  int run = 1, trials = 3;
  bool practice = false;
  std::uint64_t seed = 1;
};

inline std::string recordRun(const std::string& folder, const RunToRecord& what) {
  const experiment::Experiment experiment = experiment::readExperiment(what.experiment);
  record::RunConfiguration c;
  c.subject = what.subject;
  c.session = what.session;
  c.task = session::labelOf(experiment.name);
  c.run = c.firstRun = what.run;
  c.condition = experiment.name;
  c.practice = what.practice;
  c.experimentName = experiment.name;
  c.experimentText = experiment.text;
  c.seed = what.seed;
  c.device = what.device;
  c.clock = "virtual";
  for (int i = 0; i < what.trials; ++i) c.trials.push_back({i, 0, false});
  c.table = record::makeChannelTable(experiment, constraints::makeConstraint(experiment.constraint).parameterCount());

  const std::string path = session::logPath({folder, what.subject, what.session}, c.task, what.run);
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  haptics::LoopOptions options;
  options.virtualClock = true;
  haptics::RunConductor run(experiment::CompiledExperiment(experiment), devices::makeDevice(what.device, experiment, what.seed), c.trials,
                            options);
  record::RecorderOptions recording;
  recording.threaded = false;
  record::Recorder recorder(path, c, recording);
  run.start(&recorder);
  const std::atomic<bool> stop{false};
  while (run.runTrial(stop)) continue;
  run.finish();
  return path;
}

/// What is left of a dataset when nobody has kept its logs.
inline void removeLogs(const std::string& folder, const std::string& log) {
  std::vector<record::RunLog> runs;
  runs.push_back(record::RunLog::open(log));
  record::writeBids(runs, folder);
  std::filesystem::remove_all(folder + "/sourcedata");
}

/// A fixture with an empty folder. Its tests record runs into the folder and open them as a dataset.
class RecordedDataset : public InAFolder {
 protected:
  std::string record(const RunToRecord& what) const { return recordRun(folder_.path(), what); }
  Dataset opened() const { return openDataset(folder_.path()); }
};

}  // namespace reachlab::analysis
