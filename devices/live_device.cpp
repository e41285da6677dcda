#include "devices/live_device.h"

#include <algorithm>

#include "base/system/triple_buffer.h"
#include "devices/make_device.h"
#include "sim/haptics/device_watch.h"
#include "sim/haptics/run_sink.h"

namespace reachlab::devices {

/// Times between reports, by the clock at which each came; of a device that does not count them, between ticks.
class LiveDevice::Intervals final : public haptics::RunSink {
 public:
  bool onTick(const haptics::TickState& state, trial::Command, std::uint32_t) noexcept override {
    const haptics::DeviceSample& sample = state.hands[0].device;
    const std::int64_t now = sample.takenNs != 0 ? sample.takenNs : state.measuredNs;
    const std::uint64_t came = sample.reports != 0 ? sample.reports : state.tick;
    if (came == before_ || !sample.valid) return true;
    // Reports that came between two ticks are known by their number alone.
    const std::uint64_t count = before_ != 0 && came > before_ ? came - before_ : 0;
    if (count > 0) {
      const double seconds = static_cast<double>(now - beforeNs_) * 1e-9 / static_cast<double>(count);
      const auto bin = static_cast<std::size_t>(std::clamp(seconds / kBinSeconds, 0.0, static_cast<double>(kBins - 1)));
      counts_.between[bin] += count;
      counts_.reports += count;
      counts_.ns += now - beforeNs_;
      told_.publish(counts_);
    }
    before_ = came;
    beforeNs_ = now;
    return true;
  }
  std::uint32_t massesEvery() const noexcept override { return 0; }

  void fill(View& view) {
    if (const Counts* newest = told_.takeLatest()) known_ = *newest;
    view.between = known_.between;
    view.reports = known_.reports;
    view.rate = known_.ns > 0 ? static_cast<double>(known_.reports) / (static_cast<double>(known_.ns) * 1e-9) : 0;
  }

 private:
  struct Counts {
    std::array<std::uint64_t, kBins> between{};
    std::uint64_t reports = 0;
    std::int64_t ns = 0;  // in which they came
  };
  std::uint64_t before_ = 0;  // the haptic thread's
  std::int64_t beforeNs_ = 0;
  Counts counts_;
  TripleBuffer<Counts> told_;
  Counts known_;  // the controlling thread's
};

LiveDevice::LiveDevice(const std::string& spec, const experiment::CompiledExperiment& experiment)
    : device_(makeDevice(spec, experiment, 1)), intervals_(std::make_unique<Intervals>()),
      loop_(std::make_unique<haptics::HapticLoop>(std::make_unique<haptics::TickEngine>(experiment, haptics::engineOptions(*device_)),
                                                  device_, intervals_.get())) {
  newest_ = loop_->engine().state();
  loop_->start();
}

LiveDevice::~LiveDevice() { loop_->stop(); }

LiveDevice::View LiveDevice::look() {
  if (const haptics::TickState* newer = loop_->takeLatest()) haptics::copyState(*newer, newest_);
  const haptics::HandState& hand = newest_.hands[0];
  View view{};
  view.position = hand.device.position;
  view.force = hand.deviceForce;
  view.buttons = hand.device.buttons;
  view.valid = hand.device.valid;
  view.speed = norm(hand.hip.velocity);
  intervals_->fill(view);
  const std::string said = device_->healthText(), name = device_->info().name;
  const bool isLost = device_->health() == haptics::DeviceHealth::Lost;
  if (!isLost && loop_->fault() == haptics::DeviceFault::Device) loop_->resetFault();  // it is back; nothing is felt here
  if (isLost) view.fault = "device " + name + " is lost";
  else if (const haptics::DeviceFault fault = loop_->fault(); fault != haptics::DeviceFault::None)
    view.fault = haptics::describe(fault, name);
  if (!said.empty()) view.fault += (view.fault.empty() ? "" : ": ") + said;
  return view;
}

}  // namespace reachlab::devices
