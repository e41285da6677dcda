#include "analysis/chosen_trials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>

#include "base/error.h"
#include "base/fault.h"

namespace reachlab::analysis {

namespace fs = std::filesystem;

bool isMotionFile(const std::string& path) { return path.ends_with("_motion.tsv"); }

Recording openRecording(const std::string& path, ScenesOfRuns& known) {
  if (isMotionFile(path)) {
    RunSource run = readBidsRun(path);
    std::vector<experiment::CompiledExperiment> scenes = readBidsExperiments(run, path).scenes;
    return {std::move(run), std::move(scenes)};
  }
  const auto log = std::make_shared<const record::RunLog>(record::RunLog::open(path, record::LogCheck::Trials));
  return {{log->configuration(), log->trials(), [log](std::uint64_t first, std::uint64_t last) { return log->rows(first, last); },
           record::readMarks(*log)},
          known.of(log->configuration())};
}

record::TrialIndex indexMotionFiles(const std::string& folder, const record::IndexProgress& progress) {
  std::vector<std::string> files;
  try {
    files = findBidsRuns(folder);
  } catch (const FaultError&) {
    // Another program's recordings have no trials, forces or masses that could be shown.
    std::set<std::string> systems;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string(), key = "tracksys-";
      if (const std::size_t at = name.find(key); isMotionFile(name) && at != std::string::npos)
        systems.insert(name.substr(at, name.find('_', at) - at));
    }
    if (systems.empty()) throw;
    throw FaultError(Fault{.what = fmt::format("has no logs, and its motion files are not of Reachlab: {}", fmt::join(systems, ", ")),
                           .allowed = "a dataset with logs in sourcedata, or with motion files named …_tracksys-haptic_…_motion.tsv",
                           .place = FilePlace{folder}});
  }
  record::TrialIndex index;
  for (const std::string& file : files) {
    if (progress && !progress(index.read, files.size())) break;
    ++index.read;
    try {
      const RunSource source = readBidsRun(file);
      record::IndexedRun run = record::indexedRunOf(file, source.configuration);
      run.trials = source.trials;
      for (record::RecordedTrial& trial : run.trials) trial.peakHandSpeed = trial.handPathLength = kNotMeasured;  // not in the tables
      index.runs.push_back(std::move(run));
    } catch (const Error& error) {
      index.unreadable.emplace_back(error.what());
    }
  }
  return index;
}

namespace {

// Trial by trial, as they are read. Returns the conditions of what was read.
std::vector<Condition> readInto(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn,
                                const std::function<void(TrialData&& trial, std::size_t condition)>& add) {
  DatasetIndex index;
  ScenesOfRuns known;
  for (const ChosenTrials& some : chosen) {
    if (goOn && !goOn()) break;
    Recording recording = openRecording(some.log, known);
    std::vector<record::RecordedTrial> wanted;
    for (const int number : some.trials) {
      const auto& all = recording.run.trials;
      const auto trial = std::find_if(all.begin(), all.end(), [&](const auto& t) { return t.trial == number; });
      if (trial != all.end()) wanted.push_back(*trial);
    }
    recording.run.trials = std::move(wanted);
    addRun(recording.run, recording.scenes, index, {add, {}});
  }
  return std::move(index.conditions);
}

}  // namespace

AnalysisInput readChosen(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn) {
  AnalysisInput input;
  input.conditions = readInto(chosen, goOn, [&](TrialData&& trial, std::size_t condition) {
    input.trials.push_back(std::move(trial));
    input.conditionOf.push_back(condition);
  });
  return input;
}

Analysis analyzeChosen(std::span<const ChosenTrials> chosen, const AnalysisOptions& options, const ChosenProgress& progress) {
  AnalysisBuilder builder(options);
  std::vector<Condition> conditions = readInto(chosen, {}, [&](TrialData&& trial, std::size_t condition) {
    if (progress) progress();
    builder.add(std::move(trial), condition);
  });
  return builder.finish(std::move(conditions), [&](std::size_t, std::size_t) {
    if (progress) progress();
  });
}

}  // namespace reachlab::analysis
