#pragma once
#include <string>
#include <vector>

namespace reachlab::devices {

struct VelocityTableSettings {
  std::vector<double> resolutions{0.02e-3, 0.055e-3, 0.1e-3};  // [m] encoder steps at the handle; docs/devices.md lists those of devices
  double cutoff = 40;                                          // [Hz] of the estimators with a cutoff
};

/// The errors of one estimator on recorded reaches that a device of this resolution gives at 1 kHz.
struct VelocityRow {
  std::string kind;
  double resolution = 0;  // [m]
  double delay = 0;       // [s] delay that explains the estimate best: least RMS of v^(t) - v(t - delay), to 0.05 ms
  double noise = 0;       // [m/s] RMS of the rest after that delay, each axis
  double error = 0;       // [m/s] RMS of v^(t) - v(t), as the coupling and the judge see it
  double worst = 0;       // [m/s] largest |v^(t) - v(t)|
};

/// Every estimator at every resolution, over all reaches of `path` (as the device replay plays them, 0.2 m along x). The true velocity is
/// the central difference of the played C2 curve, counted from where the recording itself is played. `difference` is the first. Throws as
/// readReach does.
std::vector<VelocityRow> compareVelocityEstimators(const std::string& path, const VelocityTableSettings& settings);

}  // namespace reachlab::devices
