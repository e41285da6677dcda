#include "devices/vendor/clock_timing.h"

#include <cmath>
#include <memory>

#include "base/system/os.h"
#include "devices/vendor/phantom_device.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/haptic_loop.h"

namespace reachlab::devices {

std::vector<ClockTiming> compareClocks(const std::string& name, double seconds) {
  const experiment::CompiledExperiment experiment = experiment::openExperiment("chain-slow");
  std::vector<ClockTiming> rows;
  for (const bool drivesClock : {true, false}) {
    PhantomDevice::Options options;
    options.name = name;
    options.drivesClock = drivesClock;
    const auto device = std::make_shared<PhantomDevice>(options);
    haptics::HapticLoop loop(std::make_unique<haptics::TickEngine>(experiment, haptics::engineOptions(*device)), device, nullptr);
    loop.start();
    os::sleepUntil(os::now() + std::llround(seconds * 1e9));
    const haptics::LoopReport report = loop.report();
    const FrameTimes& times = device->times();
    ClockTiming row;
    row.clock = drivesClock ? "device" : "computer";
    row.rate = report.rate;
    row.ticks = report.ticks;
    row.missed = report.faults.missedTicks;
    const auto fill = [](const haptics::LatenessHistogram& of, double& p50, double& p99, double& most) {
      p50 = of.percentile(0.5) * 1e-9;
      p99 = of.percentile(0.99) * 1e-9;
      most = of.max() * 1e-9;
    };
    fill(times.jitter, row.jitterP50, row.jitterP99, row.jitterMax);
    fill(times.age, row.ageP50, row.ageP99, row.ageMax);
    rows.push_back(row);
    loop.stop();
  }
  return rows;
}

}  // namespace reachlab::devices
