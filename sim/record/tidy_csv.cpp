#include "sim/record/tidy_csv.h"

#include <fmt/format.h>

#include "base/ticks.h"
#include "sim/record/append_file.h"
#include "sim/record/column_dictionary.h"
#include "base/table_text.h"
#include "sim/record/trial_measures.h"

namespace reachlab::record {
namespace {

const std::vector<std::string> kTrialColumns{"subject",
                                             "session",
                                             "run",
                                             "block",
                                             "trial",
                                             "phase",
                                             "condition",
                                             "outcome",
                                             "reason",
                                             "mass",
                                             "movement_time_s",
                                             "by",
                                             "by_unit",
                                             "experiment",
                                             "day",
                                             "order_index",
                                             "catch_trial",
                                             "foreperiod_s",
                                             "target_time_s",
                                             "position_tolerance_m",
                                             "velocity_tolerance_m_per_s",
                                             "time_tolerance_s",
                                             "start_s",
                                             "armed_s",
                                             "go_s",
                                             "onset_s",
                                             "end_s",
                                             "reaction_time_s",
                                             "peak_hand_speed_m_per_s",
                                             "hand_path_m",
                                             "peak_force_n",
                                             "mean_force_n",
                                             "clamped_ticks",
                                             "missed_ticks",
                                             "dropped_samples",
                                             "elapsed_s",
                                             "complete",
                                             "seed",
                                             "device",
                                             "age_years",
                                             "sex",
                                             "handedness",
                                             "notes"};

// What the experiment asked for; an experiment that this version cannot read any more leaves these cells empty.
experiment::Task taskOf(const RunConfiguration& configuration) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  experiment::Task unknown;
  unknown.duration = kUnknown;
  unknown.tolerance = {kUnknown, kUnknown, kUnknown};
  try {
    return recordedExperiment(configuration).task.value_or(unknown);
  } catch (const std::runtime_error&) {
    return unknown;
  }
}

void addTrial(TableText& table, const RunConfiguration& c, const experiment::Task& task, const RecordedTrial& t) {
  const TrialTimes times = timesOf(t);
  table.cell(c.subject).cell(c.session).whole(c.run).whole(c.block).whole(t.trial);
  table.cell(c.practice ? "practice" : "recorded").cell(c.condition);
  table.cell(trial::nameOf(t.result.outcome)).cell(trial::nameOf(t.result.reason)).whole(t.result.mass);
  table.number(movementTimeOf(t)).number(t.result.by).cell(unitOf(t.result.reason));
  table.cell(c.experimentName).whole(c.day).whole(t.planned.index).whole(t.planned.catchTrial ? 1 : 0);
  table.number(secondsOf(t.planned.foreperiodTicks)).number(task.duration);
  table.number(task.tolerance.position).number(task.tolerance.velocity).number(task.tolerance.time);
  for (const double time : {times.start, times.armed, times.go, times.onset, times.end, times.reaction}) table.number(time);
  for (const double measure : {t.peakHandSpeed, t.handPathLength, t.peakForce, t.meanForce}) table.number(measure);
  table.whole(static_cast<long long>(t.clampedTicks)).whole(static_cast<long long>(t.missedTicks));
  table.whole(static_cast<long long>(t.droppedTicks)).number(t.elapsed).whole(t.complete ? 1 : 0);
  table.cell(fmt::format("{}", c.seed)).cell(c.device);
  table.number(c.participant.age.value_or(std::numeric_limits<double>::quiet_NaN()));
  table.cell(c.participant.sex).cell(c.participant.handedness).cell(c.notes);
  table.endRow();
}

}  // namespace

std::string unitOf(trial::Reason reason) {
  switch (reason) {
    case trial::Reason::Position: return "m";
    case trial::Reason::Velocity: return "m/s";
    case trial::Reason::TimeShort:
    case trial::Reason::TimeLong: return "s";
    default: return "";
  }
}

std::string runName(const RunConfiguration& c, const std::string& between) {
  return fmt::format("sub-{}_ses-{}_task-{}_{}run-{:02}", c.subject, c.session, c.task, between, c.run);
}

std::string trialsCsv(const std::vector<RunLog>& runs) {
  TableText table(',', "");
  table.row(kTrialColumns);
  for (const RunLog& run : runs) {
    const experiment::Task task = taskOf(run.configuration());
    for (const RecordedTrial& trial : run.trials()) addTrial(table, run.configuration(), task, trial);
  }
  return table.text();
}

std::string samplesCsv(const RunLog& run) {
  TableText table(',', "");
  for (const Channel& channel : run.configuration().table.channels) table.cell(channel.column);
  table.endRow();
  const SampleRows rows = run.allRows();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < rows.columns; ++column) table.number(rows.at(row, column));
    table.endRow();
  }
  return table.text();
}

std::vector<std::string> writeTidyCsv(const std::vector<RunLog>& runs, const std::string& folder) {
  std::vector<std::string> written;
  const auto write = [&](const std::string& name, const std::string& text) {
    written.push_back(fmt::format("{}/{}", folder, name));
    writeFileAtomically(written.back(), text);
  };
  for (const RunLog& run : runs) {
    const std::string name = runName(run.configuration()) + "_samples.csv", samples = samplesCsv(run);
    write(name, samples);
    write(dictionaryPathOf(name), samplesDictionary(run.configuration().table, samples));
  }
  const std::string trials = trialsCsv(runs);
  write("trials.csv", trials);
  write("trials.json", trialsDictionary(trials));
  return written;
}

}  // namespace reachlab::record
