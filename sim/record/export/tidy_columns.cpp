#include <fmt/format.h>

#include <functional>
#include <map>

#include "base/ticks.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/export/run_tables.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/export/trial_row.h"

namespace reachlab::record {
namespace {

struct Row {
  const RunConfiguration& run;
  const experiment::Task& task;
  const RecordedTrial& trial;
  TrialTimes times;
  const RunScene* scene;  // null: the run has only one
};

struct TrialColumn {
  std::string name, sentence;
  std::function<TrialCell(const Row&)> of;
};

TrialColumn measured(std::string_view name) {
  const TickMeasure& measure = tickMeasure(name);
  return {std::string(measure.name), std::string(measure.sentence), [&measure](const Row& r) { return measure.of(r.trial); }};
}

double whole(auto number) { return static_cast<double>(number); }
std::string textOf(std::string_view words) { return std::string(words); }

const std::vector<TrialColumn>& trialColumns() {
  static const std::vector<TrialColumn> kColumns{
      {"subject", "Subject's label, letters and digits; read it as text: 01 is not 1", [](const Row& r) { return r.run.subject; }},
      {"session", "Session's label, letters and digits; read it as text: 01 is not 1", [](const Row& r) { return r.run.session; }},
      {"run", "Run number within the session, as in the file names", [](const Row& r) { return whole(r.run.run); }},
      {"block", "Block of the session's plan, from 1", [](const Row& r) { return whole(r.run.block); }},
      {"trial", "Trial number within the block, from 1", [](const Row& r) { return whole(r.trial.trial); }},
      {"phase",
       "Whether the block counts: practice or recorded. In the samples files a column of this name is the trial's own phase, a number",
       [](const Row& r) { return textOf(r.run.practice ? "practice" : "recorded"); }},
      {"condition",
       "Condition: kind and target of the trial where its block has several, else condition of the plan, else the experiment's name",
       [](const Row& r) { return conditionOf(r.run, r.trial.planned); }},
      {"kind", "Kind of the trial in the plan; empty where its block has no kinds",
       [](const Row& r) { return r.scene != nullptr ? r.scene->kind : std::string(); }},
      {"target",
       "Target of the trial in the plan, from 1, such as 3, and 3-back on the way back from it; empty where its block has one scene",
       [](const Row& r) { return r.scene != nullptr ? r.scene->target : std::string(); }},
      {"outcome", "How the trial ended: success, failure, aborted or interrupted",
       [](const Row& r) { return textOf(trial::nameOf(r.trial.result.outcome)); }},
      {"reason", "Which tolerance was missed, or what stopped the trial; none for a success",
       [](const Row& r) { return textOf(trial::nameOf(r.trial.result.reason)); }},
      measured("mass"),
      measured("movement_time_s"),
      measured("by"),
      {"by_unit", "Unit of by: m, m/s or s; empty where there is no excess", [](const Row& r) { return unitOf(r.trial.result.reason); }},
      {"experiment", "Name of the experiment", [](const Row& r) { return r.run.experimentName; }},
      {"day", "Day of the plan; 0: the plan has none", [](const Row& r) { return whole(r.run.day); }},
      {"order_index", "Place of the trial in the planned order, from 0", [](const Row& r) { return whole(r.trial.planned.index); }},
      {"catch_trial", "1: no go signal was given, the hand should stay; 0: a reach",
       [](const Row& r) { return whole(r.trial.planned.catchTrial); }},
      {"foreperiod_s", "Planned time from arming to the go signal",
       [](const Row& r) { return secondsOf(r.trial.planned.foreperiodTicks); }},
      {"target_time_s", "Duration that the task asks for", [](const Row& r) { return r.task.duration; }},
      {"position_tolerance_m", "Tolerance of every mass's position at the target", [](const Row& r) { return r.task.tolerance.position; }},
      {"velocity_tolerance_m_per_s", "Tolerance of every mass's speed at the target",
       [](const Row& r) { return r.task.tolerance.velocity; }},
      {"time_tolerance_s", "Tolerance of the duration", [](const Row& r) { return r.task.tolerance.time; }},
      {"start_s", "Start of the trial, since the first sample", [](const Row& r) { return r.times.start; }},
      {"armed_s", "When the hand was in place, since the first sample", [](const Row& r) { return r.times.armed; }},
      {"go_s", "Go signal, since the first sample", [](const Row& r) { return r.times.go; }},
      {"task_onset_s", "When the hand had moved by onset_m from its position at arming, since the first sample",
       [](const Row& r) { return r.times.onset; }},
      {"end_s", "End of the movement, since the first sample", [](const Row& r) { return r.times.end; }},
      measured("task_reaction_time_s"),
      measured("peak_hand_speed_m_per_s"),
      measured("hand_path_m"),
      measured("peak_force_n"),
      measured("mean_force_n"),
      measured("clamped_ticks"),
      {"channel_broken", "1: the hand left the walls of a channel, which let go; 0: it did not",
       [](const Row& r) { return whole(r.trial.channelBroken); }},
      measured("missed_ticks"),
      measured("dropped_samples"),
      measured("elapsed_s"),
      {"complete", "0: the log broke off in this trial, also where it was mended since",
       [](const Row& r) { return whole(r.trial.complete && r.trial.result.reason != trial::Reason::Program); }},
      // As text, because a double cannot hold every seed.
      {"seed", "Seed of the session, as it is asked for; up to 64 bits, read it as text or as an integer, not as a floating-point number",
       [](const Row& r) { return fmt::format("{}", r.run.sessionSeed); }},
      {"device", "Device as it was asked for", [](const Row& r) { return r.run.device; }},
      {"age_years", "Participant's age",
       [](const Row& r) { return r.run.participant.age.value_or(std::numeric_limits<double>::quiet_NaN()); }},
      {"sex", "Participant's sex: F, M or O", [](const Row& r) { return r.run.participant.sex; }},
      {"handedness", "Participant's handedness: R, L or A", [](const Row& r) { return r.run.participant.handedness; }},
      {"notes", "Notes by the experimenter", [](const Row& r) { return r.run.notes; }}};
  return kColumns;
}

}  // namespace

void eachTrial(const RunLog& run, const std::function<void(std::span<const TrialCell> cells)>& take) {
  const RunConfiguration& c = run.configuration();
  const std::uint64_t first = run.firstSampleTick();
  std::map<int, experiment::Task> tasks;  // of the scenes, each read once
  for (const RecordedTrial& trial : run.trials()) {
    auto task = tasks.find(trial.planned.scene);
    if (task == tasks.end()) task = tasks.emplace(trial.planned.scene, taskOf(c, trial.planned)).first;
    const Row row{c, task->second, trial, timesOf(trial, first), sceneOf(c, trial.planned)};
    std::vector<TrialCell> cells;
    for (const TrialColumn& column : trialColumns()) cells.push_back(column.of(row));
    take(cells);
  }
}

const std::vector<std::string>& trialColumnNames() {
  static const auto kNames = [] {
    std::vector<std::string> names;
    for (const TrialColumn& column : trialColumns()) names.push_back(column.name);
    return names;
  }();
  return kNames;
}

std::string trialsDictionary(std::string_view csv) {
  std::vector<ColumnMeaning> meanings;
  for (const TrialColumn& column : trialColumns()) meanings.push_back({column.name, column.sentence});
  return columnDictionary(csv, meanings);
}

std::string samplesDictionary(const RunLog& run, std::string_view csv) {
  const RunConfiguration& configuration = run.configuration();
  const std::string clock = clockStatement(run);
  std::vector<ColumnMeaning> meanings{
      {"phase",
       "Phase of the trial at this sample: 0 idle, 1 waiting, 2 armed, 3 moving, 4 done. In trials.csv a column of this name says whether "
       "the block is practice or recorded"}};
  for (const Channel& channel : configuration.table.channels)
    meanings.push_back({channel.column, channel.type == "LATENCY" ? std::string_view(clock) : std::string_view(channel.description)});
  return columnDictionary(csv, meanings);
}

}  // namespace reachlab::record
