#include "devices/live_device.h"

#include <algorithm>

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
      bins_[bin].store(bins_[bin].load(std::memory_order_relaxed) + count, std::memory_order_relaxed);
      total_.store(total_.load(std::memory_order_relaxed) + count, std::memory_order_relaxed);
      ns_.store(ns_.load(std::memory_order_relaxed) + (now - beforeNs_), std::memory_order_relaxed);
    }
    before_ = came;
    beforeNs_ = now;
    return true;
  }
  std::uint32_t massesEvery() const noexcept override { return 0; }

  void fill(View& view) const {
    for (std::size_t i = 0; i < kBins; ++i) view.between[i] = bins_[i].load(std::memory_order_relaxed);
    view.reports = total_.load(std::memory_order_relaxed);
    const double seconds = static_cast<double>(ns_.load(std::memory_order_relaxed)) * 1e-9;
    view.rate = seconds > 0 ? static_cast<double>(view.reports) / seconds : 0;
  }

 private:
  std::uint64_t before_ = 0;  // the haptic thread's
  std::int64_t beforeNs_ = 0;
  std::array<std::atomic<std::uint64_t>, kBins> bins_{};
  std::atomic<std::uint64_t> total_{0};
  std::atomic<std::int64_t> ns_{0};
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
  if (const haptics::DeviceFault fault = loop_->fault(); fault != haptics::DeviceFault::None) view.fault = haptics::describe(fault, name);
  else if (device_->health() == haptics::DeviceHealth::Lost) view.fault = "device " + name + " is lost";
  if (!said.empty()) view.fault += (view.fault.empty() ? "" : ": ") + said;
  return view;
}

}  // namespace reachlab::devices
