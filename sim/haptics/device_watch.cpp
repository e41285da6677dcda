#include "sim/haptics/device_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "base/ticks.h"
#include "sim/dynamics/hand/hand_path.h"

namespace reachlab::haptics {

namespace {

struct FaultWords {
  std::string_view name, what;
};
// In the order of DeviceFault.
constexpr FaultWords kFaults[]{
    {"none", "is in order"},
    {"silent", "gave no new report while a trial was under way; is it connected, is the machine too busy?"},
    {"jump", "jumped by more than 20 mm within a tick; check its encoders and calibrate it"},
    {"speed", "moved faster than its speed limit; was it let go?"},
    {"not_finite", "would have got a force that is not a number; the object cannot be computed here"},
    {"stalled", "was left without a tick for more than 20 ms while force was on it"},
    {"no_clock", "does not call for its tick any more; is it connected?"},
    {"device", "reports a fault of its own"},
};
static_assert(std::size(kFaults) == static_cast<std::size_t>(DeviceFault::Device) + 1);

}  // namespace

std::string describe(DeviceFault fault, const std::string& device) {
  const auto& [name, what] = kFaults[static_cast<std::size_t>(fault)];
  return fmt::format("device {} {} (fault: {}); its force is off until the fault is reset", device, what, name);
}

DeviceWatch::DeviceWatch(const DeviceInfo& info) noexcept
    : guards_(info.rendersForce), speedLimit_(info.speedLimit), silenceNs_(static_cast<std::int64_t>(info.silenceLimit * 1e9)) {}

void DeviceWatch::latch(DeviceFault fault) noexcept {
  if (fault_ == DeviceFault::None) fault_ = fault;
}

void DeviceWatch::reset() noexcept {
  fault_ = DeviceFault::None;
  seen_ = 0;
}

// Speed over the last kWindow ticks: encoder steps and reports that fall two into one tick are averaged out.
double DeviceWatch::speedOver(const Vec3& position, std::int64_t nowNs) noexcept {
  const int have = std::min(seen_, kWindow);
  double speed = 0;
  if (have == kWindow) {
    const Place& oldest = window_[static_cast<std::size_t>(seen_ % kWindow)];
    const double seconds = std::max(static_cast<double>(nowNs - oldest.ns) * 1e-9, kWindow * kTickSeconds);
    speed = norm(position - oldest.position) / seconds;
  }
  window_[static_cast<std::size_t>(seen_ % kWindow)] = {position, nowNs};
  seen_ = seen_ < 2 * kWindow - 1 ? seen_ + 1 : kWindow;
  return speed;
}

DeviceFault DeviceWatch::judge(const DeviceSample& sample, const WatchContext& context) noexcept {
  const bool first = seen_ == 0;
  const bool isNew = first || sample.reports == 0 || sample.reports != reports_;
  // A device slower than the tick moves on in steps, and so does one that was not asked for some ticks.
  const double passed = silentTicks_ + context.missed;
  const double step = first ? 0 : norm(sample.position - last_);
  silentTicks_ = isNew ? 0 : silentTicks_ + 1;
  if (isNew) reportNs_ = sample.takenNs != 0 ? std::min(sample.takenNs, context.nowNs) : context.nowNs;
  reports_ = sample.reports;
  last_ = sample.position;
  const double speed = std::max(speedOver(sample.position, context.nowNs), sample.hasVelocity ? norm(sample.velocity) : 0);
  const bool jumped = step > dynamics::kLargestJump + speedLimit_ * passed * kTickSeconds;
  if (!context.engaged && jumped) seen_ = 0;  // carried to the next start: what it did before says nothing of its speed from there
  if (!context.engaged || first) return DeviceFault::None;
  if (jumped) return DeviceFault::Jump;
  if (speed > speedLimit_) return DeviceFault::Speed;
  return context.nowNs - reportNs_ >= silenceNs_ ? DeviceFault::Silent : DeviceFault::None;
}

DeviceSample DeviceWatch::look(DeviceSample sample, const WatchContext& context) noexcept {
  if (!guards_) return sample;
  sample.released = sample.released && sample.valid;  // what is gone was not let go of
  if (sample.valid && isFinite(sample.position)) latch(judge(sample, context));
  else seen_ = 0;
  if (fault_ != DeviceFault::None) sample.released = false;
  if (fault_ != DeviceFault::None || sample.released) sample.valid = false;
  return sample;
}

}  // namespace reachlab::haptics
