#include "devices/replay/velocity_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/ticks.h"
#include "devices/replay/reach_source.h"
#include "devices/replay/replayed_reach.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/haptics/velocity_estimator.h"

namespace reachlab::devices {
namespace {

constexpr std::size_t kJoined = 450;  // [ticks] the replay's rest and its join onto the recording are not the person's

struct Followed {
  std::vector<Vec3> truth, estimate;  // [m/s] a tick each
};

std::vector<Vec3> centralDifferences(const std::vector<Vec3>& place) {
  std::vector<Vec3> velocity(place.size());
  for (std::size_t i = 1; i + 1 < place.size(); ++i) velocity[i] = (place[i + 1] - place[i - 1]) / (2 * kTickSeconds);
  return velocity;
}

Vec3 quantised(const Vec3& v, double step) {
  const auto rounded = [step](double x) { return step * std::round(x / step); };
  return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

// RMS an axis against the truth of `delay` earlier, linear between ticks.
double residual(const std::vector<Followed>& all, double delay) {
  const double ticks = delay / kTickSeconds;
  const auto whole = static_cast<std::size_t>(ticks);
  const double part = ticks - static_cast<double>(whole);
  double squares = 0;
  std::size_t count = 0;
  for (const Followed& one : all)
    for (std::size_t i = std::max(whole + 1, kJoined); i < one.truth.size(); ++i) {
      const Vec3 off = one.estimate[i] - ((1 - part) * one.truth[i - whole] + part * one.truth[i - whole - 1]);
      squares += dot(off, off);
      count += 3;
    }
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(count, 1)));
}

VelocityRow judge(const std::string& kind, double resolution, const std::vector<Followed>& all) {
  constexpr double kStep = 0.05e-3, kMost = 30e-3;  // [s]
  VelocityRow row{kind, resolution, 0, residual(all, 0), residual(all, 0), 0};
  for (double delay = kStep; delay <= kMost; delay += kStep)
    if (const double left = residual(all, delay); left < row.noise) row.noise = left, row.delay = delay;
  for (const Followed& one : all)
    for (std::size_t i = kJoined; i < one.truth.size(); ++i) row.worst = std::max(row.worst, norm(one.estimate[i] - one.truth[i]));
  return row;
}

}  // namespace

std::vector<VelocityRow> compareVelocityEstimators(const std::string& path, const VelocityTableSettings& settings) {
  std::vector<subjects::PlayedReach> reaches;
  for (const RecordedReach& reach : readReaches(reachSourceOf(path))) reaches.push_back(layOnto(reach, {-0.1, 0, 0}, {0.1, 0, 0}));
  std::vector<VelocityRow> rows;
  for (const double resolution : settings.resolutions)
    for (const std::string& kind : experiment::velocityEstimatorNames()) {
      if (kind == "device" || kind == "auto") continue;  // what a device measures itself is its maker's secret
      std::vector<Followed> all;
      for (const subjects::PlayedReach& reach : reaches) {
        haptics::VelocityEstimator estimator({kind, settings.cutoff});
        Followed followed{centralDifferences(reach.position), {}};
        for (const Vec3& place : reach.position) {
          haptics::DeviceSample sample;
          sample.position = quantised(place, resolution);
          followed.estimate.push_back(estimator.estimate(sample));
        }
        all.push_back(std::move(followed));
      }
      rows.push_back(judge(kind, resolution, all));
    }
  return rows;
}

}  // namespace reachlab::devices
