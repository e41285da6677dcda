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

figure::Series line(std::string label, const std::vector<double>& x, const std::vector<double>& y, figure::Color color, double width) {
  figure::Series series;
  series.label = std::move(label);
  series.x = x, series.y = y;
  series.color = color;
  series.width = width;
  return series;
}

figure::Rule mark(double at, std::string label) {
  figure::Rule rule;
  rule.at = at;
  rule.label = std::move(label);
  return rule;
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
  figure::Panel speed, force;
  speed.title = "(a) Speed";
  force.title = "(b) Coupling force";
  speed.x.label = force.x.label = profile.sinceOnset ? "Time from onset (s)" : "Time since the trial was prepared (s)";
  speed.y.label = "Speed (m/s)";
  force.y.label = "Force (N)";
  speed.series = {line("hand", profile.time, profile.handSpeed, figure::palette::kBlack, figure::kThick)};
  if (masses > 1) speed.series.push_back(line("mass 1", profile.time, profile.firstSpeed, figure::palette::kBlue, figure::kNormal));
  if (masses > 0)
    speed.series.push_back(
        line(fmt::format("mass {}", masses), profile.time, profile.lastSpeed, figure::palette::kVermilion, figure::kNormal));
  force.series = {line("", profile.time, profile.force, figure::palette::kBlack, figure::kNormal)};
  const experiment::Experiment experiment = record::recordedValues(log.configuration(), trial.planned);
  if (profile.sinceOnset && experiment.task) {
    const experiment::Task& task = *experiment.task;
    speed.rules = {mark(0, "onset"), mark(task.duration - task.tolerance.time, "T − ΔT"),
                   mark(task.duration + task.tolerance.time, "T + ΔT")};
  }
  figure::Figure figure;
  figure.columns = 2;
  figure.panels = {std::move(speed), std::move(force)};
  return figure;
}

}  // namespace reachlab::cli
