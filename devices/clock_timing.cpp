#include "devices/clock_timing.h"

#include <cmath>
#include <memory>

#include "base/fault.h"
#include "base/system/os.h"
#include "devices/make_device.h"
#include "devices/vendor/phantom_device.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/haptic_loop.h"
#include "sim/haptics/lateness.h"

namespace reachlab::devices {
namespace {

/// Of a device that does not count its frames: what the ticks show, once each has written its force.
class TickTimes final : public haptics::RunSink {
 public:
  bool onTick(const haptics::TickState& state, trial::Command, std::uint32_t) noexcept override {
    const std::int64_t now = os::now();
    if (beforeNs_ != 0) jitter.add(std::abs(now - beforeNs_ - haptics::LoopCore::kPeriodNs));
    beforeNs_ = now;
    if (state.hands[0].device.takenNs != 0) age.add(now - state.hands[0].device.takenNs);
    return true;
  }
  std::uint32_t massesEvery() const noexcept override { return 0; }

  haptics::LatenessHistogram jitter, age;

 private:
  std::int64_t beforeNs_ = 0;
};

void fill(const haptics::LatenessHistogram& of, double& p50, double& p99, double& most) {
  p50 = of.percentile(0.5) * 1e-9;
  p99 = of.percentile(0.99) * 1e-9;
  most = of.max() * 1e-9;
}

ClockTiming measure(const std::shared_ptr<haptics::HapticDevice>& device, const experiment::CompiledExperiment& experiment,
                    double seconds) {
  const auto sink = std::make_shared<TickTimes>();
  haptics::HapticLoop loop(std::make_unique<haptics::TickEngine>(experiment, haptics::engineOptions(*device)), device, sink.get());
  loop.start();
  os::sleepUntil(os::now() + std::llround(seconds * 1e9));
  const haptics::LoopReport report = loop.report();
  ClockTiming row;
  row.clock = device->info().drivesClock ? "device" : "computer";
  row.rate = report.rate;
  row.ticks = report.ticks;
  row.missed = report.faults.missedTicks;
  const auto* phantom = dynamic_cast<const PhantomDevice*>(device.get());
  fill(phantom != nullptr ? phantom->times().jitter : sink->jitter, row.jitterP50, row.jitterP99, row.jitterMax);
  fill(phantom != nullptr ? phantom->times().age : sink->age, row.ageP50, row.ageP99, row.ageMax);
  loop.stop();  // the zero that it writes is no tick
  return row;
}

}  // namespace

std::vector<ClockTiming> measureLatency(const std::string& spec, double seconds) {
  const experiment::CompiledExperiment experiment = experiment::openExperiment("chain-slow");
  std::vector<ClockTiming> rows;
  std::vector<std::string> ways{spec};
  if (const std::string other = byComputersClock(spec); other != spec) ways.push_back(other);
  for (const std::string& way : ways) {
    const std::shared_ptr<haptics::HapticDevice> device = makeDevice(way, experiment, 1);
    if (device->info().virtualHand)
      throw FaultError(
          Fault{"device", "is " + spec + ", which is simulated and has no latency", "a device as `reach list devices` has it"});
    rows.push_back(measure(device, experiment, seconds));
  }
  return rows;
}

}  // namespace reachlab::devices
