#include "cli/output/trial_profile.h"

#include <fmt/format.h>

#include <cmath>

#include "base/ticks.h"
#include "sim/experiment/experiment.h"

namespace reachlab::cli {
namespace {

// Magnitude over the rows of the vector whose channels are NAME_x, NAME_y, NAME_z.
std::vector<double> magnitudeOf(const record::SampleRows& rows, const record::ChannelTable& table, const std::string& name) {
  const std::size_t x = table.indexOf(name + "_x");
  std::vector<double> values(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) values[i] = std::hypot(rows.at(i, x), rows.at(i, x + 1), rows.at(i, x + 2));
  return values;
}

}  // namespace

ShownTrial profileOf(const record::RunLog& log, const record::RecordedTrial& trial) {
  const record::ChannelTable& table = log.configuration().table;
  const record::SampleRows rows = log.rows(trial);
  ShownTrial profile;
  profile.sinceOnset = trial.result.onsetTick > 0;
  const std::uint64_t begin = profile.sinceOnset ? trial.result.onsetTick : trial.startTick;
  for (const std::uint64_t tick : rows.ticks) profile.time.push_back(secondsBetween(begin, tick));
  profile.handSpeed = magnitudeOf(rows, table, "hand_vel");
  if (table.massCount > 0) {
    profile.firstSpeed = magnitudeOf(rows, table, "mass1_vel");
    profile.lastSpeed = magnitudeOf(rows, table, fmt::format("mass{}_vel", table.massCount));
  }
  profile.force = magnitudeOf(rows, table, "coupling_force");
  return profile;
}

figure::Figure drawTrial(const record::RunLog& log, const record::RecordedTrial& trial) {
  const ShownTrial profile = profileOf(log, trial);
  const int masses = log.configuration().table.massCount;
  const figure::Axis time{.label = profile.sinceOnset ? "Time from onset (s)" : "Time since the trial was prepared (s)"};
  figure::Panel speed{.title = "(a) Speed", .x = time, .y = {.label = "Speed (m/s)"}};
  speed.series = {{.label = "hand", .x = profile.time, .y = profile.handSpeed, .width = figure::kThick}};
  if (masses > 1) speed.series.push_back({.label = "mass 1", .x = profile.time, .y = profile.firstSpeed, .color = figure::palette::kBlue});
  if (masses > 0)
    speed.series.push_back(
        {.label = fmt::format("mass {}", masses), .x = profile.time, .y = profile.lastSpeed, .color = figure::palette::kVermilion});
  const figure::Panel force{
      .title = "(b) Coupling force", .x = time, .y = {.label = "Force (N)"}, .series = {{.x = profile.time, .y = profile.force}}};
  const experiment::Experiment experiment = record::recordedValues(log.configuration(), trial.planned);
  if (profile.sinceOnset && experiment.task) {
    const experiment::Task& task = *experiment.task;
    speed.rules = {{.at = 0, .label = "onset"},
                   {.at = task.duration - task.tolerance.time, .label = "T − ΔT"},
                   {.at = task.duration + task.tolerance.time, .label = "T + ΔT"}};
  }
  return {.panels = {std::move(speed), force}, .columns = 2};
}

}  // namespace reachlab::cli
