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
    return recordedValues(configuration).task.value_or(unknown);
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

void writeRows(const RunLog& run, TableText table, const TakePiece& take) {
  run.eachBlock([&](const SampleRows& block) {
    for (std::size_t row = 0; row < block.size(); ++row) {
      for (std::size_t column = 0; column < block.columns; ++column) table.number(block.at(row, column));
      table.endRow();
    }
    take(table.takeText());
  });
}

void trialsCsv(const std::vector<RunLog>& runs, const TakePiece& take) {
  TableText table(',', "");
  table.row(kTrialColumns);
  for (const RunLog& run : runs) {
    const experiment::Task task = taskOf(run.configuration());
    for (const RecordedTrial& trial : run.trials()) {
      addTrial(table, run.configuration(), task, trial);
      take(table.takeText());
    }
  }
  take(table.takeText());
}

void samplesCsv(const RunLog& run, const TakePiece& take) {
  TableText table(',', "");
  for (const Channel& channel : run.configuration().table.channels) table.cell(channel.column);
  table.endRow();
  take(table.takeText());
  writeRows(run, std::move(table), take);
}

std::vector<std::string> writeTidyCsv(const std::vector<RunLog>& runs, const std::string& folder) {
  std::vector<std::string> written;
  // The table, and beside it its dictionary, which asks for the table's first line.
  const auto write = [&](const std::string& name, const auto& writer, const auto& dictionaryOf) {
    std::string header;
    AtomicFile table(written.emplace_back(fmt::format("{}/{}", folder, name)));
    writer([&](std::string_view piece) {
      if (header.empty()) header = piece.substr(0, piece.find('\n'));
      table.append(piece);
    });
    table.commit();
    writeFileAtomically(written.emplace_back(fmt::format("{}/{}", folder, dictionaryPathOf(name))), dictionaryOf(header));
  };
  for (const RunLog& run : runs)
    write(
        runName(run.configuration()) + "_samples.csv", [&](const TakePiece& take) { samplesCsv(run, take); },
        [&](const std::string& header) { return samplesDictionary(run.configuration().table, header); });
  write(
      "trials.csv", [&](const TakePiece& take) { trialsCsv(runs, take); }, trialsDictionary);
  return written;
}

}  // namespace reachlab::record
