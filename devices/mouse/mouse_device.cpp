#include "devices/mouse/mouse_device.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/fault.h"
#include "base/ticks.h"
#include "devices/driver/drivers.h"

namespace reachlab::devices {
namespace {

constexpr double kNs = 1e-9;
constexpr double kForget = 5;                // [s] within which a slow window's lateness is forgotten
constexpr std::int64_t kStill = 60'000'000;  // [ns] without an event: the pointer rests, and what it was late by says nothing

}  // namespace

MouseDevice::MouseDevice(const Vec3& at, std::int64_t (*now)()) : now_(now), position_(at) {
  ring_[0].place = at;
  ring_[0].ns = INT64_MIN / 2;  // for ever
  count_ = 1;
}

void MouseDevice::point(const Vec3& place, std::int64_t eventNs) noexcept {
  if (isFinite(place)) events_.tryPush({place, eventNs, now_()});
}

haptics::DeviceInfo MouseDevice::info() const { return {.name = "mouse", .version = "2"}; }

void MouseDevice::take(const Event& event) noexcept {
  constexpr std::int64_t kLeakNs = 200;  // an event: clocks that drift apart
  const std::int64_t away = event.came - event.ns;
  offset_ = offset_ == INT64_MAX || away < offset_ ? away : offset_ + kLeakNs;
  Event ours{event.place, event.ns + offset_, event.came};
  const std::int64_t since = ours.ns - back(0).ns;
  if (since <= 0) ours.ns = back(0).ns + 1;  // two of one instant, or out of order: the later word counts
  // The next event may come as late as this one, and until then the playback must not run dry.
  const double late = kNs * static_cast<double>(event.came - ours.ns), gap = since < kStill ? kNs * static_cast<double>(since) : 0;
  wanted_ = std::clamp(std::max(wanted_, late + gap), kLeastPlayback, kMostPlayback);
  ring_[static_cast<std::size_t>(count_ % kRing)] = ours;
  count_ = count_ < 2 * kRing - 1 ? count_ + 1 : kRing;
}

Vec3 MouseDevice::played(std::int64_t ns) const noexcept {
  const int have = std::min(count_, kRing);
  for (int i = 0; i < have; ++i) {
    const Event& before = back(i);
    if (before.ns > ns) continue;
    if (i == 0) return before.place;
    const Event& after = back(i - 1);
    // From rest, the way is made in the last stretch before the next event and not over the whole pause.
    const std::int64_t from = std::max(before.ns, after.ns - kStill);
    const double share = ns <= from ? 0 : static_cast<double>(ns - from) / static_cast<double>(after.ns - from);
    return before.place + share * (after.place - before.place);
  }
  return back(have - 1).place;
}

haptics::DeviceSample MouseDevice::read() noexcept {
  const std::int64_t now = now_();
  const double passed = last_ == 0 ? 0 : kNs * static_cast<double>(now - last_);
  last_ = now;
  wanted_ = std::max(kLeastPlayback, wanted_ - (wanted_ - kLeastPlayback) * std::min(passed / kForget, 1.0));
  for (Event event; events_.tryPop(event);) take(event);

  const double behind = kNs * static_cast<double>(now - at_);  // as it is before this tick's step
  const bool resting = now - back(0).came > kStill && at_ >= back(0).ns;
  double step = behind - wanted_;
  if (at_ != 0 && !resting && std::abs(step - passed) < kMostPlayback)
    step = std::clamp(step, passed * (1 - kMostDrift), passed * (1 + kMostDrift));
  at_ = at_ == 0 ? now - static_cast<std::int64_t>(wanted_ / kNs) : at_ + static_cast<std::int64_t>(std::llround(step / kNs));
  playback_.store(kNs * static_cast<double>(now - at_), std::memory_order_relaxed);
  const Vec3 target = played(at_);

  // Exact solution of the critically damped system over one tick, with the target held.
  constexpr double w = 1 / kSmoothing;
  const double decay = std::exp(-w * kTickSeconds);
  const Vec3 away = position_ - target, slope = velocity_ + w * away;
  position_ = target + decay * (away + kTickSeconds * slope);
  velocity_ = decay * (velocity_ - w * kTickSeconds * slope);
  return {.position = position_, .velocity = velocity_, .hasVelocity = true};
}

DeviceDriver mouseDriver() {
  return {.name = "mouse",
          .usage = "mouse",
          .description = "the pointer in the window of `reachlab`",
          .find =
              [](const DeviceDriver& self) {
                std::vector<FoundDevice> rows = alwaysThere(self);
                rows.front().rate = 125;
                return rows;
              },
          .make = [](const DeviceRequest& request) -> std::unique_ptr<haptics::HapticDevice> {
            if (!request.argument.empty()) throw FaultError(Fault{"device", "mouse has no options", "mouse"});
            throw ResourceError("device mouse: needs a window to point into; use `reachlab`");
          },
          .inWindowOnly = true,
          .takesHandSettings = false};
}

}  // namespace reachlab::devices
