#include "sim/record/export/c3d_export.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "sim/record/export/run_tables.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/trial_measures.h"

namespace reachlab::record {
namespace {

constexpr double kMillimetres = 1000;  // in a metre: what most programs take C3D's points to be in

struct Columns {
  std::vector<std::size_t> points;  // of each one's x; y and z follow
  std::vector<std::size_t> signals;
};

bool isClock(const Channel& channel) { return channel.type == "LATENCY" || channel.name == "measured_time"; }

Columns addLabels(const ChannelTable& table, C3dFile& file) {
  Columns columns;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Channel& channel = table.channels[i];
    if (channel.type == "POS") {
      if (channel.component != "x") continue;
      columns.points.push_back(i);
      file.points.push_back({channel.trackedPoint, channel.description});
    } else if (!isClock(channel)) {
      columns.signals.push_back(i);
      file.analogs.push_back({channel.name, channel.description, channel.units == "n/a" ? "" : channel.units});
    }
  }
  return columns;
}

}  // namespace

C3dFile c3dOf(const RunLog& run, const RecordedTrial& trial) {
  const RunConfiguration& c = run.configuration();
  C3dFile file;
  file.rate = c.samplingHz;
  file.pointUnit = "mm";
  const Columns columns = addLabels(c.table, file);
  const SampleRows rows = run.rows(trial);
  if (rows.size() == 0) return file;
  const std::uint64_t first = rows.ticks.front(), every = c.sampleEveryTicks;
  file.frames = static_cast<std::size_t>((rows.ticks.back() - first) / every) + 1;
  file.places.assign(file.frames * columns.points.size() * 3, 0);
  file.seen.assign(file.frames * columns.points.size(), 0);
  file.signals.assign(file.frames * columns.signals.size(), std::numeric_limits<float>::quiet_NaN());
  const std::size_t valid = c.table.indexOf("valid");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto frame = static_cast<std::size_t>((rows.ticks[row] - first) / every);
    for (std::size_t k = 0; k < columns.points.size(); ++k) {
      const std::size_t at = frame * columns.points.size() + k, x = columns.points[k];
      const std::string& point = c.table.channels[x].trackedPoint;
      bool seen = rows.at(row, valid) != 0 || (point != "hand" && point != "device");
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double metres = rows.at(row, x + axis);
        seen = seen && std::isfinite(metres);
        file.places[3 * at + axis] = static_cast<float>(kMillimetres * metres);
      }
      file.seen[at] = seen ? 1 : 0;
    }
    for (std::size_t k = 0; k < columns.signals.size(); ++k)
      file.signals[frame * columns.signals.size() + k] = static_cast<float>(rows.at(row, columns.signals[k]));
  }
  const ExportClock clock(run);
  const TrialTimes times = timesOf(trial, run.firstSampleTick());
  const double begin = clock.at(first);
  for (const auto& [label, time] : {std::pair{"go", times.go}, {"onset", times.onset}, {"end", times.end}})
    if (std::isfinite(time)) file.events.push_back({label, time - begin});
  file.notes = {{"CLOCK", clockStatement(run)},
                {"BEGIN_S", fmt::format("{}", begin)},  // of the first frame
                {"SUBJECT", c.subject},
                {"SESSION", c.session},
                {"RUN", fmt::format("{}", c.run)},
                {"TRIAL", fmt::format("{}", trial.trial)},
                {"CONDITION", conditionOf(c, trial.planned)},
                {"KIND", sceneOf(c, trial.planned) != nullptr ? sceneOf(c, trial.planned)->kind : ""},
                {"TARGET", sceneOf(c, trial.planned) != nullptr ? sceneOf(c, trial.planned)->target : ""},
                {"PHASE", c.practice ? "practice" : "recorded"},
                {"CATCH_TRIAL", trial.planned.catchTrial ? "yes" : "no"},
                {"OUTCOME", std::string(trial::nameOf(trial.result.outcome))},
                {"REASON", std::string(trial::nameOf(trial.result.reason))},
                {"SOFTWARE", c.softwareVersion}};
  return file;
}

std::vector<std::string> writeC3d(const std::vector<RunLog>& runs, const std::string& folder) {
  std::vector<std::string> written;
  for (const RunLog& run : runs)
    for (const RecordedTrial& trial : run.trials()) {
      const C3dFile file = c3dOf(run, trial);
      if (file.frames == 0) continue;
      const std::string path = fmt::format("{}/{}_trial-{:03}.c3d", folder, runName(run.configuration()), trial.trial);
      writeFileAtomically(path, c3dBytes(file));
      written.push_back(path);
    }
  return written;
}

}  // namespace reachlab::record
