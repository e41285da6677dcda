#pragma once
#include <string>
#include <vector>


namespace reachlab::devices {

struct VelocityTableSettings {
  std::vector<double> resolutions{0.02e-3, 0.055e-3, 0.1e-3};  // [m] encoder steps at the handle; docs/devices.md has the devices'
  double cutoff = 40;                                          // [Hz] of the estimators that have one
};

/// How one estimator does on recorded reaches that a device of this resolution gives at 1 kHz.
struct VelocityRow {
  std::string kind;
  double resolution = 0;  // [m]
  double delay = 0;       // [s] by which the estimate is best explained: least RMS of v^(t) - v(t - delay), to 0.05 ms
  double noise = 0;       // [m/s] RMS of what is then left, each axis
  double error = 0;       // [m/s] RMS of v^(t) - v(t): what the coupling and the judge see
  double worst = 0;       // [m/s] largest |v^(t) - v(t)|
};

/// Every estimator on every resolution, over all reaches of `path` (as the device replay plays them, 0.2 m along x). The true velocity is
/// the central difference of the played C2 curve, from where the recording itself is played. `difference` first. Throws as readReach does.
std::vector<VelocityRow> compareVelocityEstimators(const std::string& path, const VelocityTableSettings& settings);

}  // namespace reachlab::devices
