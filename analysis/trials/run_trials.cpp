#include "analysis/trials/run_trials.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/longest_gap.h"
#include "base/ticks.h"
#include "constraints/constraint.h"

namespace reachlab::analysis {
namespace {

/// 0: the table has no such channel. No vector begins there.
std::size_t columnOf(const record::ChannelTable& table, std::string_view name) {
  const auto found = std::find_if(table.channels.begin(), table.channels.end(), [&](const record::Channel& c) { return c.name == name; });
  return found == table.channels.end() ? 0 : static_cast<std::size_t>(found - table.channels.begin());
}

}  // namespace

RunTrials::RunTrials(const record::ChannelTable& table, std::uint64_t every, constraints::TaskPath path, const TrialScene& scene)
    : every_(std::max<std::uint64_t>(1, every)), path_(std::move(path)), scene_(scene) {
  const std::string last = table.massCount > 0 ? fmt::format("mass{}", table.massCount) : std::string("hand");
  columns_ = {table.indexOf("hand_pos_x"),
              table.indexOf("coupling_force_x"),
              table.indexOf(last + "_pos_x"),
              table.indexOf(last + "_vel_x"),
              table.massCount > 0 && table.parameterCount == 1 ? table.indexOf("mass1_q1") : 0,
              columnOf(table, "hand_vel_x"),
              columnOf(table, "environment_force_x")};
}

/// Rows may be missing (dropped, or a tick was late); between its neighbours a missing one is interpolated.
void RunTrials::appendEvenly(TrialData& trial, const record::SampleRows& rows, std::uint64_t onset) const {
  const auto put = [&](std::size_t a, std::size_t b, double part) {
    const auto mix = [&](std::size_t column) { return (1 - part) * rows.vectorAt(a, column) + part * rows.vectorAt(b, column); };
    trial.hand.push_back(mix(columns_.hand));
    if (columns_.handVelocity > 0) trial.velocity.push_back(mix(columns_.handVelocity));
    if (columns_.environment > 0) trial.environment.push_back(mix(columns_.environment));
    trial.object.push_back(mix(columns_.object));
    trial.objectVelocity.push_back(mix(columns_.velocity));
    trial.force.push_back(norm(mix(columns_.force)));
    if (path_.bent())
      trial.along.push_back(path_.directionAt((1 - part) * rows.at(a, columns_.parameter) + part * rows.at(b, columns_.parameter)));
  };
  const double longest = longestGap(secondsOf(every_));
  std::size_t a = 0;
  for (std::uint64_t tick = rows.ticks.front(); tick <= rows.ticks.back(); tick += every_) {
    while (a + 1 < rows.size() && rows.ticks[a + 1] <= tick) ++a;
    const std::size_t b = std::min(a + 1, rows.size() - 1);
    const double gap = static_cast<double>(rows.ticks[b] - rows.ticks[a]);
    if (rows.ticks[b] > onset && gap / kTicksPerSecond > longest)
      trial.notSeen = fmt::format("hand not seen for more than {:g} s", longest);
    put(a, b, gap > 0 ? static_cast<double>(tick - rows.ticks[a]) / gap : 0);
  }
}

TrialData RunTrials::read(const record::RecordedTrial& recorded, const RowsBetween& rowsOf) const {
  TrialData trial;
  trial.catchTrial = recorded.planned.catchTrial;
  trial.result = recorded.result;
  trial.rate = kTicksPerSecond / static_cast<double>(every_);
  trial.start = path_.start();
  trial.target = path_.target();
  trial.scene = scene_;
  trial.closed = path_.bent() && path_.constraint().domain[0].periodic;
  if (path_.straight() && !(path_.directionAt(0) == Vec3{})) trial.along = {path_.directionAt(0)};
  if (recorded.armedTick == 0) return trial;
  const std::uint64_t end = recorded.result.endTick > 0 ? recorded.result.endTick : recorded.lastTick;
  const record::SampleRows rows = rowsOf(recorded.armedTick, std::max(end, recorded.armedTick));
  const auto seconds = [&](std::uint64_t tick) { return tick == 0 ? kNotMeasured : secondsBetween(recorded.armedTick, tick); };
  if (rows.size() > 0) {
    appendEvenly(trial, rows, recorded.result.onsetTick);
    const auto isKnown = [](const Vec3& v) { return isFinite(v); };
    if (!std::all_of(trial.object.begin(), trial.object.end(), isKnown) ||
        !std::all_of(trial.objectVelocity.begin(), trial.objectVelocity.end(), isKnown))
      trial.notSeen = "object not known in all samples";
    trial.first = seconds(rows.ticks.front());
    trial.goTime = seconds(recorded.goTick);
    trial.taskOnset = seconds(recorded.result.onsetTick);
    trial.taskEnd = recorded.result.onsetTick == 0 ? kNotMeasured : seconds(std::max(end, recorded.result.onsetTick));
  }
  if (recorded.result.onsetTick > 0 && recorded.peakForce > 0) {
    trial.peakForce = recorded.peakForce;
    if (recorded.meanForce > 0) trial.meanForce = recorded.meanForce;
  }
  return trial;
}

}  // namespace reachlab::analysis
