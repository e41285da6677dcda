#include "devices/virtual/stability_map.h"

#include <algorithm>

#include "base/ticks.h"

namespace reachlab::devices {

std::vector<StabilityPoint> computeStabilityMap(const DeviceModel& model, const StabilityMapSettings& settings) {
  std::vector<StabilityPoint> map;
  if (!(settings.dampingStep > 0) || !(settings.mostDamping >= 0)) return map;
  for (const double handDamping : settings.handDampings) {
    LoopSettings loop;
    loop.mass = model.mass + settings.handMass;
    loop.friction = model.viscosity + handDamping;
    loop.delayTicks = settings.delayTicks;
    loop.estimator = settings.estimator;
    const auto steps = static_cast<int>(settings.mostDamping / settings.dampingStep + 1e-9);
    for (int i = 0; i <= steps; ++i) {
      loop.damping = i * settings.dampingStep;
      const double passive = 2 * (loop.friction - loop.damping) / kTickSeconds;
      map.push_back({handDamping, loop.damping, largestStableStiffness(loop), std::max(passive, 0.0)});
    }
  }
  return map;
}

}  // namespace reachlab::devices
