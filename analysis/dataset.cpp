#include "analysis/dataset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "analysis/hands.h"
#include "analysis/measures/deviation_and_adaptation.h"
#include "analysis/tables.h"
#include "analysis/trials/equal_runs.h"
#include "analysis/trials/experiment_difference.h"
#include "analysis/trials/run_trials.h"
#include "base/error.h"
#include "base/fault.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/whole_file.h"
#include "sim/record/recover.h"

namespace reachlab::analysis {
namespace {

// "chain-moderate (duration 1.5 s)": what sets an experiment apart from the first of its name.
std::string nameApart(const std::string& name, const std::vector<std::string>& different) {
  constexpr std::size_t kMost = 2;
  const std::vector<std::string> named(different.begin(),
                                       different.begin() + static_cast<std::ptrdiff_t>(std::min(kMost, different.size())));
  return fmt::format("{} ({}{})", name, fmt::join(named, ", "), different.size() > kMost ? ", …" : "");
}

struct ConditionName {
  std::string name;
  bool pooled = false;
};

/// The condition of each scene of a run. Targets that ask for one movement in several directions are one condition: the kind of trial.
std::vector<ConditionName> conditionNames(const record::RunConfiguration& c, std::span<const experiment::CompiledExperiment> scenes) {
  if (!c.scenes) return {ConditionName{record::conditionOf(c)}};
  const auto withoutTarget = [](const record::RunScene& scene) {
    const std::string ending = " " + scene.target;
    if (scene.target.empty() || !scene.condition.ends_with(ending)) return scene.condition;
    return scene.condition.substr(0, scene.condition.size() - ending.size()) + (scene.target.ends_with("-back") ? " back" : "");
  };
  std::map<std::string, std::vector<std::size_t>> kinds;
  for (std::size_t i = 0; i < c.scenes->size(); ++i) kinds[withoutTarget((*c.scenes)[i])].push_back(i);
  std::vector<ConditionName> names;
  for (const record::RunScene& scene : *c.scenes) names.push_back({scene.condition});
  for (const auto& [name, members] : kinds)
    if (members.size() > 1 && std::all_of(members.begin() + 1, members.end(), [&](std::size_t i) {
          return differInDirectionOnly(scenes[members.front()].experiment(), scenes[i].experiment());
        }))
      for (const std::size_t i : members) names[i] = {name, true};
  return names;
}

std::size_t conditionIndex(DatasetIndex& dataset, const ConditionName& named, const experiment::CompiledExperiment& compiled) {
  const std::string& name = named.name;
  const experiment::Experiment& experiment = compiled.experiment();
  auto& conditions = dataset.conditions;
  const auto first = std::find_if(conditions.begin(), conditions.end(), [&](const Condition& c) { return c.name == name; });
  if (first == conditions.end()) {
    conditions.push_back({name, compiled, named.pooled});
    return conditions.size() - 1;
  }
  if ((named.pooled || first->pooled) && differInDirectionOnly(first->experiment(), experiment)) {
    first->pooled = true;
    return static_cast<std::size_t>(first - conditions.begin());
  }
  const std::vector<std::string> different =
      named.pooled ? differencesBesideDirection(first->experiment(), experiment) : differences(first->experiment(), experiment);
  if (different.empty()) return static_cast<std::size_t>(first - conditions.begin());
  // One name over unlike experiments would mix what cannot be compared.
  const std::string base = nameApart(name, different);
  std::string own = base;
  for (int number = 2;; ++number) {  // two may share the differences that are named; −9.81 and 9.81 would share a figure's file
    const auto known =
        std::find_if(conditions.begin(), conditions.end(), [&](const Condition& c) { return fileNameOf(c.name) == fileNameOf(own); });
    if (known == conditions.end()) break;
    if (differences(known->experiment(), experiment).empty() || (named.pooled && differInDirectionOnly(known->experiment(), experiment)))
      return static_cast<std::size_t>(known - conditions.begin());
    own = fmt::format("{} {}", base, number);
  }
  dataset.notes.push_back(
      fmt::format("{} was recorded with more than one experiment; they are kept apart. {} differs from the first in: {}", name, own,
                  fmt::join(different, ", ")));
  conditions.push_back({own, compiled, named.pooled});
  return conditions.size() - 1;
}

void noteMixedDevices(DatasetIndex& dataset) {
  std::map<std::string, std::set<std::string>> devices;
  for (const AnalysedRun& run : dataset.runs) {
    const record::RunConfiguration& c = run.configuration;
    for (const std::string& what : {record::conditionOf(c), "subject " + c.subject})
      devices[what].insert(c.device.substr(0, c.device.find(':')));
  }
  for (const auto& [what, used] : devices) {
    if (used.size() < 2) continue;
    dataset.notes.push_back(fmt::format(
        "{}: trials of different devices are analysed together ({}); give a subject's or a session's folder alone to keep them apart", what,
        fmt::join(used, ", ")));
  }
}

// The strongest of the run's scenes, else that of a run before.
std::optional<experiment::SquareMatrix<3>> trainedField(std::span<const experiment::CompiledExperiment> scenes, const std::string& subject,
                                                        DatasetIndex& index) {
  std::optional<experiment::SquareMatrix<3>> strongest;
  for (const experiment::CompiledExperiment& scene : scenes)
    if (const auto field = viscousFieldOf(scene.experiment()); field && (!strongest || std::abs(strengthOf(*field, *strongest)) > 1))
      strongest = field;
  if (strongest) index.trained[subject] = *strongest;
  const auto known = index.trained.find(subject);
  return known == index.trained.end() ? std::nullopt : std::optional(known->second);
}

}  // namespace

std::string datasetOf(const std::string& motionFile) {
  std::filesystem::path folder = std::filesystem::absolute(motionFile).parent_path();
  while (folder.has_relative_path()) {
    const std::string name = folder.filename().string();
    folder = folder.parent_path();
    if (name.starts_with("sub-")) break;
  }
  return folder.string();
}

const std::vector<experiment::CompiledExperiment>& ScenesOfRuns::of(const record::RunConfiguration& c) {
  std::string key = c.definitionText + '\0' + c.experimentText;
  for (const record::RunScene& scene : c.scenes.value_or(std::vector<record::RunScene>())) key += '\0' + scene.experimentText;
  const auto known = known_.find(key);
  return known != known_.end() ? known->second : known_.emplace(std::move(key), record::recordedScenes(c)).first->second;
}

void addRun(const RunSource& run, std::span<const experiment::CompiledExperiment> scenes, DatasetIndex& index, const TrialSink& sink) {
  const record::RunConfiguration& c = run.configuration;
  index.runs.push_back({c, run.trials.size()});
  struct Stage {
    std::size_t condition;
    RunTrials trials;
  };
  if (!scenes.front().experiment().task) {
    index.notes.push_back(fmt::format("{}: the experiment has no task; its trials are left out", c.experimentName));
    return;
  }
  const auto trained = trainedField(scenes, c.subject, index);
  const std::vector<ConditionName> names = conditionNames(c, scenes);
  std::map<int, Stage> stages;  // by scene
  const auto stageOf = [&](const trial::PlannedTrial& planned) -> Stage& {
    if (const auto known = stages.find(planned.scene); known != stages.end()) return known->second;
    const experiment::CompiledExperiment& compiled = scenes[static_cast<std::size_t>(planned.scene)];
    const experiment::Experiment& experiment = compiled.experiment();
    Stage stage{conditionIndex(index, names[static_cast<std::size_t>(planned.scene)], compiled),
                RunTrials(c.table, c.sampleEveryTicks, {compiled.constraint(), experiment.task->start, experiment.task->target},
                          sceneOf(experiment, trained))};
    return stages.emplace(planned.scene, std::move(stage)).first->second;
  };
  if (!c.scenes) stageOf({});  // a run without trials has a condition, too
  for (const record::RecordedTrial& recorded : run.trials) {
    const Stage& stage = stageOf(recorded.planned);
    const std::size_t condition = stage.condition;
    TrialData trial = stage.trials.read(recorded, run.rowsOf);
    trial.key = {c.subject, c.session, index.conditions[condition].name, c.day, c.run, c.block, recorded.trial};
    if (const record::RunScene* scene = record::sceneOf(c, recorded.planned))
      trial.key.kind = scene->kind, trial.key.target = scene->target;
    trial.practice = c.practice;
    if (const record::TrialMark* mark = run.marks.find(recorded.trial)) {
      trial.excluded = mark->excluded;
      trial.markedOnset = mark->onset.value_or(kNotMeasured);
      trial.markedOffset = mark->offset.value_or(kNotMeasured);
    }
    sink.add(std::move(trial), condition);
  }
}

BidsExperiments readBidsExperiments(const RunSource& run, const std::string& motionFile, const std::string& experimentFile) {
  const record::RunConfiguration& c = run.configuration;
  const std::string own = datasetOf(motionFile) + "/" + record::experimentPath(c);
  if (experimentFile.empty() && isThere(own)) return {record::experimentsFromJson(record::readWholeFile(own), own, c), true};
  const std::size_t scenes = c.scenes ? c.scenes->size() : 1;
  return {std::vector(scenes, experiment::openExperiment(experimentFile.empty() ? c.experimentName : experimentFile)), false};
}

namespace {

void readLogs(const std::vector<std::string>& logs, DatasetIndex& dataset, const TrialSink& sink, const DatasetProgress& progress) {
  ScenesOfRuns parsed;
  EqualRuns equalRuns;
  std::map<std::string, std::string> labels;  // path by the run's name
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (progress) progress(i, logs.size(), logs[i]);
    const std::size_t conditions = dataset.conditions.size(), runs = dataset.runs.size(), notes = dataset.notes.size();
    if (sink.beginRun) sink.beginRun();
    bool handing = false;  // a trial to the sink: if that fails, it is not the reading
    const TrialSink handed{[&](TrialData&& trial, std::size_t condition) {
                             handing = true;
                             sink.add(std::move(trial), condition);
                             handing = false;
                           },
                           {},
                           {}};
    // A run that fails half-way is taken back: its trials, and what the index says because of it.
    const auto leaveOut = [&](const Error& error) {
      if (sink.takeBackRun) sink.takeBackRun();
      dataset.conditions.erase(dataset.conditions.begin() + static_cast<std::ptrdiff_t>(conditions), dataset.conditions.end());
      dataset.runs.resize(runs);
      dataset.notes.resize(notes);
      equalRuns.forget(logs[i]);
      std::erase_if(labels, [&](const auto& label) { return label.second == logs[i]; });
      dataset.notes.push_back(fmt::format("{}: left out: {}", logs[i], error.what()));
    };
    try {
      const record::RunLog log = record::RunLog::open(logs[i]);
      const record::RunConfiguration& c = log.configuration();
      const std::vector<experiment::CompiledExperiment>& scenes = parsed.of(c);
      if (const std::string twin = equalRuns.twinOf(logs[i], c, log.trials()); !twin.empty()) {
        dataset.notes.push_back(fmt::format(
            "{}: left out: it is {} recorded again (same experiment, seed and movements); two equal runs count once", logs[i], twin));
        continue;
      }
      if (const auto [known, fresh] = labels.emplace(record::runName(c), logs[i]); !fresh)
        dataset.notes.push_back(fmt::format("{} and {} are both recorded as {}; both count", known->second, logs[i], known->first));
      if (const int repeats = countRepeats(log.trials()); repeats > 0)
        dataset.notes.push_back(
            fmt::format("{}: {} of {} trials repeat an earlier one exactly (a hand without noise, or a reach replayed again); they count",
                        logs[i], repeats, log.trials().size()));
      const record::RunMarks marks = record::readMarks(log);
      addRun({c, log.trials(), [&](std::uint64_t first, std::uint64_t last) { return log.rows(first, last); }, marks}, scenes, dataset,
             handed);
      dataset.runs.back().file = logs[i];
      dataset.runs.back().isLog = true;
      if (const std::string loss = record::lossOf(log); !loss.empty()) dataset.notes.push_back(loss);
      else if (!log.healthy()) dataset.notes.push_back(logs[i] + ": is being recorded into; read to its last record");
    } catch (const ResourceError& error) {
      if (handing) throw;
      leaveOut(error);
      dataset.unreadable.emplace_back(error.what());
    } catch (const Error& error) {
      leaveOut(error);
    }
  }
}

/// A dataset without logs, from its BIDS files.
void readExported(const std::string& folder, DatasetIndex& dataset, const TrialSink& sink, const std::string& experimentFile,
                  const DatasetProgress& progress) {
  bool foreign = false;  // an experiment that may not be the recorded one
  const std::vector<std::string> runs = findBidsRuns(folder);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (progress) progress(i, runs.size(), runs[i]);
    const RunSource run = readBidsRun(runs[i]);
    const BidsExperiments recorded = readBidsExperiments(run, runs[i], experimentFile);
    if (!recorded.own) foreign = true;
    addRun(run, recorded.scenes, dataset, sink);
    dataset.runs.back().file = runs[i];
  }
  dataset.notes.push_back(std::string("no logs in sourcedata/: read from the BIDS files, with the experiments ") +
                          (foreign ? "as they are shipped or given now" : "in code/experiments/"));
  if (hasSeveralHands(dataset)) dataset.notes.emplace_back("hands.csv is written from logs alone");
}

}  // namespace

DatasetIndex readDataset(const std::string& folder, const TrialSink& sink, const std::string& experimentFile,
                         const DatasetProgress& progress) {
  DatasetIndex dataset;
  std::vector<std::string> logs;
  try {
    logs = record::findLogs(folder);
  } catch (const FaultError&) {
    // No logs: the exported files may still be there.
  }
  if (logs.empty()) readExported(folder, dataset, sink, experimentFile, progress);
  else readLogs(logs, dataset, sink, progress);
  if (dataset.runs.empty()) {
    std::vector<Fault> why{{{}, "nothing to analyse", {}, FilePlace{folder}}};
    for (const std::string& note : dataset.notes) why.push_back({.what = note});
    if (!dataset.unreadable.empty()) throw ResourceError(toText(why));
    throw FaultError(std::move(why));
  }
  noteMixedDevices(dataset);
  return dataset;
}

}  // namespace reachlab::analysis
