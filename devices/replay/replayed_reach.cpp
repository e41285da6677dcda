#include "devices/replay/replayed_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/fault.h"
#include "base/math/cubic_spline.h"
#include "base/math/minimum_jerk.h"
#include "base/ticks.h"
#include "constraints/geometry/task_path.h"
#include "devices/driver/drivers.h"
#include "devices/replay/reach_checks.h"
#include "devices/replay/reach_source.h"
#include "sim/trial/protocol.h"

namespace reachlab::devices {
namespace {

constexpr double kLongestReach = 600;       // [s]
constexpr double kRest = 0.3, kJoin = 0.1;  // [s]

// Turns `from` onto `to` (unit vectors) by the smallest rotation: v + w x v + w x (w x v)/(1 + c), w = from x to (Rodrigues).
Vec3 turn(const Vec3& v, const Vec3& from, const Vec3& to) {
  const Vec3 w = cross(from, to);
  const double c = dot(from, to);
  if (c > -1 + 1e-12) return v + cross(w, v) + cross(w, cross(w, v)) / (1 + c);
  // Opposite: half a turn about any axis across.
  const Vec3 helper = std::abs(from.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 axis = cross(from, helper) / norm(cross(from, helper));
  return 2 * dot(axis, v) * axis - v;
}

}  // namespace

subjects::PlayedReach layOnto(const RecordedReach& reach, const Vec3& start, const Vec3& target) {
  if (reach.time.size() < 2) refuse({reach.file}, "fewer than two samples");
  if (const double lasts = reach.time.back() - reach.time.front(); !(lasts <= kLongestReach))
    refuse({reach.file}, fmt::format("lasts {} s", lasts), fmt::format("a reach of at most {:.0f} s", kLongestReach), "time_s");
  const Vec3 first = reach.position.front();
  const auto distance = [&](const Vec3& p) { return norm(p - first); };
  const Vec3 far = *std::max_element(reach.position.begin(), reach.position.end(),
                                     [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
  const Vec3 chord = far - first, wanted = target - start;
  const double length = norm(chord), asked = norm(wanted);
  if (!(length > 0)) refuse({reach.file}, "the hand does not move");
  if (!(asked > 0)) throw FaultError(constraints::samePlaceFault());

  std::vector<Vec3> laid;
  laid.reserve(reach.position.size());
  for (const Vec3& p : reach.position) laid.push_back(start + asked / length * turn(p - first, chord / length, wanted / asked));
  const CubicSpline spline(reach.time, laid, SplineEnds::Natural);

  subjects::PlayedReach played;
  const double begin = reach.time.front(), whole = reach.time.back() - begin;
  const auto ticks = static_cast<std::size_t>(std::ceil((kRest + whole) / kTickSeconds - 1e-9));
  for (std::size_t i = 0; i <= ticks; ++i) {
    const double t = static_cast<double>(i) * kTickSeconds - kRest;
    const double blend = minimumJerk(std::clamp(t / kJoin, 0.0, 1.0));
    const Vec3 recorded = spline.at(begin + std::clamp(t, 0.0, whole)).value;
    played.position.push_back(start + blend * (recorded - start));
  }
  return played;
}

std::unique_ptr<haptics::HapticDevice> makeReplayHand(const std::string& argument, const Vec3& start, const Vec3& target) {
  std::vector<subjects::PlayedReach> reaches;
  for (const RecordedReach& reach : readReaches(reachSourceOf(argument))) reaches.push_back(layOnto(reach, start, target));
  const haptics::DeviceInfo info{.name = "replay", .version = "1"};
  return std::make_unique<subjects::PlayedHand>(
      info, [reaches = std::move(reaches)](int trial) { return reaches[static_cast<std::size_t>(trial) % reaches.size()]; });
}

namespace {

std::unique_ptr<haptics::HapticDevice> makeReplay(const DeviceRequest& request) {
  if (request.argument.empty()) throw FaultError(Fault{"device", "replay: what to replay is missing", "replay:FILE, replay:FOLDER"});
  const trial::ProtocolSettings task = trial::makeProtocolSettings(request.experiment.experiment(), request.experiment.constraint());
  return makeReplayHand(request.argument, task.start, task.target);
}

}  // namespace

DeviceDriver replayDriver() {
  return {.name = "replay",
          .usage = "replay:FILE|FOLDER[,KEY=VALUE…]",
          .description = "replay:FILE|FOLDER, recorded reaches (CSV, BIDS motion, C3D) laid onto start and target, one a trial",
          .find = alwaysThere,
          .make = makeReplay,
          .isMade = true,
          .takesHandSettings = false};
}

}  // namespace reachlab::devices
