#pragma once
#include <fmt/format.h>

#include <limits>
#include <string>
#include <vector>

#include "base/ticks.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/run_log.h"
#include "sim/record/log/trial_measures.h"

/// One row a trial, as every export of tables has it (docs/recording.md lists the columns).
namespace reachlab::record {

inline const std::vector<std::string> kTrialColumns{"subject",
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

/// What the experiment asked for; an experiment that this version cannot read any more leaves these cells empty.
experiment::Task taskOf(const RunConfiguration& configuration);

/// `table` takes cells of text, numbers and whole numbers (TableText, ColumnTable).
template <class Table>
void addTrial(Table& table, const RunConfiguration& c, const experiment::Task& task, const RecordedTrial& t) {
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
  table.cell(fmt::format("{}", c.seed)).cell(c.device);  // text: a double cannot hold every seed
  table.number(c.participant.age.value_or(std::numeric_limits<double>::quiet_NaN()));
  table.cell(c.participant.sex).cell(c.participant.handedness).cell(c.notes);
  table.endRow();
}

}  // namespace reachlab::record
